"""What stands where in the street."""
from .cars import car
from .lamps import lamp_post, wall_lantern
from .layout import KERB, PAVE, left, right
from .mesh import solid
from .props import bench, bollard, cafe_table, tree
from .signs import neon, pharmacy_cross, traffic_light


def furniture():
    for k in range(10):
        lamp_post(-KERB - 0.5, 9.5 + 16.5 * k)
        lamp_post(KERB + 0.5, 17.5 + 16.5 * k)
    wall_lantern(left, 22.6, 2.7)
    wall_lantern(right, 8.6, 2.7)
    bench(-5.0, 13.2)
    tree(4.75, 12.6, 7.2, 5)
    tree(-4.9, 31.5, 7.6, 8)
    tree(4.9, 57.5, 7.4, 13)
    for k in range(9):
        bollard(-KERB - 0.45, 6.2 + 1.65 * k + (0.8 if k == 2 else 0))
    for y in (7.4, 9.6):
        cafe_table(-6.15, y)
    cafe_table(-6.15, 11.8)
    for y, p in ((10.2, 'paint0'), (15.6, 'paint2'), (21.4, 'paint1'), (46, 'paint3'), (51.6, 'paint2'), (63, 'paint0'), (80, 'paint1')):
        car(3.0, y, 1, p)
    for y, p in ((49, 'paint0'), (55, 'paint1'), (90, 'paint3'), (96, 'paint2')):
        car(-3.05, y, -1, p)
    car(0.75, 29.0, 1, 'paint3', lamps=True)
    car(-2.35, 74.0, -1, 'paint2', lamps=True)
    traffic_light(4.35, 32.2)
    neon('HOTEL', right, 27.0, 0.45, 4.6, 0.62, (26, 2.2, 1.6), 0.038, vertical=True, across=True)
    neon('CAFE', left, 17.2, 0.4, 3.25, 0.5, (16, 7.5, 1.5), 0.03, across=True, watts=40)
    neon('BAR', right, 46.0, 0.4, 5.4, 0.8, (2.0, 14, 22), 0.045, across=True, watts=25)
    pharmacy_cross(left, 28.0, 1.1, 4.9, 0.55, (1.0, 20, 4.0))
    solid.lathe(-KERB - 0.6, 24.6, [(0.22, 0), (0.25, 0.05), (0.25, 0.9), (0.27, 0.92), (0.2, 0.95)], 'green', 14, PAVE)
