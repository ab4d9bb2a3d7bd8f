"""Properties > Render > Fog."""
import bpy

from . import shadows, tool
from .rendering import state


class BrumePanel(bpy.types.Panel):
    bl_idname = "RENDER_PT_brume"
    bl_label = "Fog"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header(self, context):
        self.layout.prop(context.scene.brume, "enabled", text="")

    def draw(self, context):
        layout, fog = self.layout, context.scene.brume
        layout.use_property_split = True
        try:
            tool.path()
        except tool.ToolError as error:
            layout.label(text=str(error), icon="ERROR")
        column = layout.column()
        for name in ("visibility", "scattering", "absorption", "g", "falloff"):
            column.prop(fog, name)
        if fog.falloff > 0:
            column.prop(fog, "ground")
        row = layout.row()
        row.operator("brume.take_volume")
        row.operator("brume.take_mist")
        layout.prop(fog, "use_lights")
        if fog.use_lights:
            layout.prop(fog, "sun_distance")
            layout.prop(fog, "shadow_maps")
            if fog.shadow_maps:
                layout.prop(fog, "shadow_size")
                left_out = shadows.without(context.scene)
                if left_out:
                    layout.label(text=f"No shadow maps, being points or areas: {', '.join(left_out)}", icon="INFO")
        layout.prop(fog, "sky")
        if fog.sky == "DISTANCE":
            layout.prop(fog, "sky_distance")
        layout.prop(fog, "quality")
        layout.prop(fog, "output")
        layout.operator("brume.setup")
        row = layout.row()
        row.operator("brume.preview")
        row.operator("brume.fog_frames")
        layout.operator("brume.export")
        if state.problem:
            layout.label(text=state.problem, icon="ERROR")
        elif state.done:
            layout.label(text=f"{state.done} frames in fog", icon="CHECKMARK")


def register():
    bpy.utils.register_class(BrumePanel)


def unregister():
    bpy.utils.unregister_class(BrumePanel)
