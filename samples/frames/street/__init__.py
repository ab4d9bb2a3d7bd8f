"""A night street, modelled from no other file, and the same on every run.

Units are metres, z is up, the street runs along +y.  There is no fog: fog is what Brume adds.
"""
from .buildings import rows
from .furniture import furniture
from .ground import ground
from .lights import make_lights
from .materials import materials
from .mesh import glows, panes, solid
from .sky_camera import add_camera, sky


def build(sc):
    """Models the street into a scene; the camera."""
    rows()
    ground()
    furniture()
    mats = materials()
    solid.make(mats)
    ob = panes.make(mats)
    ob.visible_diffuse = False
    ob = glows.make(mats)
    ob.visible_diffuse = ob.visible_glossy = ob.visible_shadow = False
    make_lights()
    sky()
    return add_camera(sc)
