"""What the panel shows, kept with the scene, and the preferences."""
import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, PointerProperty, StringProperty


class BrumeFog(bpy.types.PropertyGroup):
    enabled: BoolProperty(name="Fog", description="Fog each frame as it is written", default=False)
    output: StringProperty(name="Foggy frames", subtype="DIR_PATH", default="fogged",
                           description="Folder that foggy frames are written to; without // or / below that of the frames")
    visibility: FloatProperty(name="Visibility", default=150, min=0.01, soft_max=5000, subtype="NONE",
                              description="How far one sees [m]: 2 % of the contrast are left")
    scattering: FloatVectorProperty(name="Scatters", size=3, default=(1, 1, 1), min=0, soft_max=1, subtype="COLOR",
                                    description="Share of the fog's extinction that is scattered")
    absorption: FloatVectorProperty(name="Absorbs", size=3, default=(0, 0, 0), min=0, soft_max=1, subtype="COLOR",
                                    description="Share of the fog's extinction that is absorbed")
    g: FloatProperty(name="Anisotropy", default=0.8, min=-1, max=1, description="Mean cosine of what is scattered; fog has about .8")
    falloff: FloatProperty(name="Height falloff", default=0, min=0, soft_max=1, precision=4,
                           description="How fast the fog thins with height [1/m]; 0: not at all")
    ground: FloatProperty(name="Ground", default=0, subtype="DISTANCE", unit="LENGTH",
                          description="Height at which the fog is as thick as the visibility says, with a height falloff")
    use_lights: BoolProperty(name="Lamps glow", default=True, description="Lamps of the scene light the fog")
    sun_distance: FloatProperty(name="Sun's way", default=50, min=0, subtype="DISTANCE", unit="LENGTH",
                                description="Length of fog that a sun's light has come through")
    shadow_maps: BoolProperty(name="Shadow maps", default=False,
                              description="Render what stands in the light of spots and suns, for scene files and frames that are fogged afterwards")
    shadow_size: IntProperty(name="Map size", default=1024, min=16, max=8192, subtype="PIXEL",
                             description="Width and height of a shadow map; what shall throw a shadow is two pixels wide or more")
    sky: EnumProperty(name="Sky", default="FOG", items=(
        ("FOG", "Infinitely far", "Fog that has no end hides the sky"), ("KEEP", "Without fog", "The sky stays as it is"),
        ("DISTANCE", "At a distance", "There is fog before the sky, but not without end")))
    sky_distance: FloatProperty(name="Distance", default=500, min=0, subtype="DISTANCE", unit="LENGTH")
    quality: EnumProperty(name="Quality", default="NONE", items=(
        ("NONE", "Default", "As the effects have it"), ("DRAFT", "Draft", "Errors below .3"),
        ("STANDARD", "Standard", "Errors below .1"), ("FINAL", "Final", "Errors below .03")))


class BrumePreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    tool: StringProperty(name="Command", subtype="FILE_PATH", description="The command brume; empty: where the system looks for commands")

    def draw(self, context):
        self.layout.prop(self, "tool")


_classes = (BrumeFog, BrumePreferences)


def register():
    for made in _classes:
        bpy.utils.register_class(made)
    bpy.types.Scene.brume = PointerProperty(type=BrumeFog)


def unregister():
    del bpy.types.Scene.brume
    for made in reversed(_classes):
        bpy.utils.unregister_class(made)
