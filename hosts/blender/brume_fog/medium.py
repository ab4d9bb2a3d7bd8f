"""What the fog is made of: to the scene file, and from what Blender has of it."""
KOSCHMIEDER = 3.912  # visibility times extinction: a contrast of 2 % is left


class MediumError(Exception):
    pass


def block(fog):
    """A scene file's medium, of the panel's values."""
    extinction = KOSCHMIEDER / fog.visibility
    medium = {"scattering": [extinction * share for share in fog.scattering],
              "absorption": [extinction * share for share in fog.absorption], "g": fog.g}
    if fog.falloff > 0:
        medium["density"] = [{"type": "exponential", "value": 1.0, "falloff": fog.falloff, "direction": [0, 0, 1],
                              "origin": [0, 0, fog.ground]}]
    return medium


def take_mist(scene, fog):
    """What is at the end of the mist is as good as invisible."""
    if scene.world is None:
        raise MediumError("the scene has no world, and so no mist")
    mist = scene.world.mist_settings
    fog.visibility = (mist.start + mist.depth) * scene.unit_settings.scale_length
    fog.scattering, fog.absorption = (1, 1, 1), (0, 0, 0)
    fog.falloff = 0


def _value(node, name):
    socket = node.inputs[name]
    if socket.is_linked:
        raise MediumError(f"{node.name}: {name} is linked; expected a value")
    value = socket.default_value
    return value if isinstance(value, (int, float)) else tuple(value)[:3]


def take_volume(scene, fog):
    """The values of the world's volume, which is unlinked: rendered and put in afterwards, the fog would be there twice."""
    tree = scene.world.node_tree if scene.world and scene.world.use_nodes else None
    output = tree.get_output_node("ALL") if tree else None
    link = next(iter(output.inputs["Volume"].links), None) if output else None
    if link is None:
        raise MediumError("the world has no volume")
    node, per_metre = link.from_node, 1 / scene.unit_settings.scale_length
    g, absorption = fog.g, (0.0, 0.0, 0.0)
    if node.bl_idname == "ShaderNodeVolumeScatter":
        density, g = _value(node, "Density"), _value(node, "Anisotropy")
        scattering = [density * c for c in _value(node, "Color")]
    elif node.bl_idname == "ShaderNodeVolumeAbsorption":
        density, scattering = _value(node, "Density"), (0.0, 0.0, 0.0)
        absorption = [density * max(1 - c, 0) for c in _value(node, "Color")]
    elif node.bl_idname == "ShaderNodeVolumePrincipled":
        density, g = _value(node, "Density"), _value(node, "Anisotropy")
        color, tint = _value(node, "Color"), _value(node, "Absorption Color")
        scattering = [density * c for c in color]
        absorption = [density * max(1 - c, 0) * max(1 - max(t, 0) ** 0.5, 0) for c, t in zip(color, tint)]
    else:
        raise MediumError(f"the world's volume is a {node.name}; expected Principled Volume, Volume Scatter or Volume Absorption")
    extinction = max(s + a for s, a in zip(scattering, absorption))
    if extinction <= 0:
        raise MediumError(f"{node.name}: its density is {density:g}; expected a medium")
    fog.visibility = KOSCHMIEDER / (extinction * per_metre)
    fog.scattering = [s / extinction for s in scattering]
    fog.absorption = [a / extinction for a in absorption]
    fog.g, fog.falloff = g, 0
    tree.links.remove(link)
