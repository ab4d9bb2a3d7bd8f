"""Shorthand for the node trees of materials."""
import bpy


class Nodes:
    """A material, and its node tree while it is built."""

    def __init__(self, name):
        self.mat = bpy.data.materials.new(name)
        self.mat.use_nodes = True
        self.t = self.mat.node_tree
        self.t.nodes.clear()

    def n(self, kind, props=None, **inputs):
        node = self.t.nodes.new('ShaderNode' + kind)
        for k, v in (props or {}).items():
            setattr(node, k, v)
        for k, v in inputs.items():
            self.put(node.inputs[int(k[1:]) if k[0] == 'i' and k[1:].isdigit() else k.replace('_', ' ')], v)
        return node

    def put(self, socket, v):
        if isinstance(v, bpy.types.NodeSocket):
            self.t.links.new(v, socket)
        elif isinstance(v, bpy.types.Node):
            self.t.links.new(v.outputs[0], socket)
        else:
            socket.default_value = v

    def math(self, op, a, b=0.0, c=0.0, clamp=False):
        return self.n('Math', {'operation': op, 'use_clamp': clamp}, i0=a, i1=b, i2=c)

    def noise(self, scale, detail=2.0, rough=0.5, vec=None):
        vec = vec or self.n('NewGeometry').outputs['Position']
        return self.n('TexNoise', Vector=vec, Scale=scale, Detail=detail, Roughness=rough).outputs['Fac']

    def ramp(self, fac, lo, hi, a, b):
        """Value a below lo, b above hi, smooth between."""
        return self.n('MapRange', {'interpolation_type': 'SMOOTHSTEP'}, i0=fac, i1=lo, i2=hi, i3=a, i4=b).outputs[0]

    def mix(self, fac, a, b, blend='MIX'):
        return self.n('MixRGB', {'blend_type': blend}, Fac=fac, Color1=a, Color2=b).outputs[0]

    def out(self, shader):
        self.t.links.new(shader.outputs[0], self.n('OutputMaterial').inputs['Surface'])
        return self.mat


def rgb(r, g, b):
    return (r, g, b, 1.0)
