"""The plan of the street: its measures, its facades, its bend, and the chance that varies it."""
import random

# One generator for the whole scene, so what each part draws depends on the order in which street.build makes them.
rng = random.Random(1897)

KERB = 4.0      # half width of the carriageway
WALL = 7.0      # half width between the facades
PAVE = 0.12     # height of the pavement
END = 186.0     # where the rows of houses end


def bend(p):
    """The street curves to the right, so the far facades and lamps are not all seen end on."""
    x, y, z = p
    return (x + 0.00042 * max(0.0, y - 30.0) ** 2, y, z)


def right(a, d, z):
    return (WALL - d, a, z)


def left(a, d, z):
    return (-WALL + d, a, z)
