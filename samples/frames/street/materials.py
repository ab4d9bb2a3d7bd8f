"""The materials, by the names that the meshes use."""
from .nodes import Nodes, rgb


def plain(name, colour, rough=0.6, spec=0.4, metallic=0.0, coat=0.0):
    m = Nodes(name)
    return m.out(m.n('BsdfPrincipled', Base_Color=rgb(*colour), Roughness=rough, Specular=spec,
                     Metallic=metallic, Clearcoat=coat, Clearcoat_Roughness=0.08))


def along_wall(m):
    """(distance along the wall, height, 0): walls face x or y, so x + y runs along either."""
    p = m.n('SeparateXYZ', Vector=m.n('NewGeometry').outputs['Position'])
    return m.n('CombineXYZ', X=m.math('ADD', p.outputs[0], p.outputs[1]), Y=p.outputs[2]).outputs[0]


def stains(m, colour):
    """Weathering: broad blotches, and dirt towards the ground."""
    z = m.n('SeparateXYZ', Vector=m.n('NewGeometry').outputs['Position']).outputs[2]
    c = m.mix(m.ramp(m.noise(0.7, 4, 0.6), 0.3, 0.7, 0.0, 0.35), colour, rgb(0.05, 0.045, 0.04))
    return m.mix(m.ramp(z, 0.0, 1.3, 0.45, 0.0), c, rgb(0.03, 0.03, 0.03))


def stucco(name, colour):
    m = Nodes(name)
    return m.out(m.n('BsdfPrincipled', Base_Color=stains(m, rgb(*colour)), Roughness=0.85, Specular=0.15))


def brick(name, a, b):
    m = Nodes(name)
    t = m.n('TexBrick', {'offset': 0.5}, Vector=along_wall(m), Color1=rgb(*a), Color2=rgb(*b),
            Mortar=rgb(0.16, 0.14, 0.12), Scale=1.0, Mortar_Size=0.008, Brick_Width=0.26, Row_Height=0.085)
    return m.out(m.n('BsdfPrincipled', Base_Color=stains(m, t.outputs[0]), Roughness=0.8, Specular=0.2))


def asphalt(name):
    """Wet after rain: puddles mirror the lamps, the rest stretches them into streaks."""
    m = Nodes(name)
    wet = m.ramp(m.noise(0.42, 3, 0.55), 0.5, 0.62, 0.0, 1.0)
    pos = m.n('NewGeometry').outputs['Position']
    # The grain fades with distance, where it would be noise smaller than a pixel.
    far = m.ramp(m.n('CameraData').outputs['View Distance'], 4.0, 22.0, 1.0, 0.0)
    bump = m.n('Bump', Strength=m.math('MULTIPLY', far, m.math('MULTIPLY_ADD', wet, -0.33, 0.35)), Distance=0.02,
               Height=m.noise(16.0, 2, 0.6, pos))
    colour = m.mix(m.noise(1.3, 4, 0.65), rgb(0.035, 0.036, 0.04), rgb(0.085, 0.083, 0.08))
    colour = m.mix(wet, colour, rgb(0.022, 0.023, 0.026))
    return m.out(m.n('BsdfPrincipled', Base_Color=colour, Specular=m.math('MULTIPLY_ADD', wet, 0.32, 0.16), Normal=bump,
                     Roughness=m.math('MULTIPLY_ADD', wet, -0.2, 0.34)))


def paving(name):
    m = Nodes(name)
    p = m.n('NewGeometry').outputs['Position']
    t = m.n('TexBrick', {'offset': 0.5}, Vector=p, Color1=rgb(0.17, 0.16, 0.15), Color2=rgb(0.12, 0.115, 0.11),
            Mortar=rgb(0.04, 0.04, 0.04), Scale=1.0, Mortar_Size=0.012, Brick_Width=0.75, Row_Height=0.5)
    wet = m.ramp(m.noise(0.6, 3, 0.6), 0.45, 0.65, 0.0, 1.0)
    colour = m.mix(m.math('MULTIPLY', wet, 0.5), t.outputs[0], rgb(0.03, 0.03, 0.03))
    return m.out(m.n('BsdfPrincipled', Base_Color=colour, Specular=0.4, Roughness=m.math('MULTIPLY_ADD', wet, -0.25, 0.6)))


def emitter(name, shape):
    """Light of the colour stored with each face, shaped by shape(m, u, v)."""
    m = Nodes(name)
    uv = m.n('SeparateXYZ', Vector=m.n('UVMap', {'uv_map': 'uv'}))
    e = m.n('Emission', Color=m.n('Attribute', {'attribute_name': 'glow'}).outputs['Color'],
            Strength=shape(m, uv.outputs[0], uv.outputs[1]))
    # Not sampled as a light: these are many, and the lights that stand for them are far less noisy.
    m.mat.cycles.sample_as_light = False
    return m.out(e)


def flat_shape(m, u, v):
    return 1.0


def room_shape(m, u, v):
    """Curtains drawn to the sides with folds in them, a ceiling lamp behind the upper half."""
    side = m.math('ABSOLUTE', m.math('SUBTRACT', u, 0.5))
    fold = m.math('MULTIPLY_ADD', m.math('SINE', m.math('MULTIPLY', u, 95.0)), 0.12, 0.42)
    open_ = m.ramp(side, 0.26, 0.32, 1.0, 0.0)
    height = m.ramp(v, 0.0, 1.0, 0.55, 1.15)
    body = m.math('ADD', m.math('MULTIPLY', open_, m.math('SUBTRACT', 1.0, fold)), fold)
    return m.math('MULTIPLY', body, height)


def blind_shape(m, u, v):
    return m.ramp(v, 0.0, 1.0, 0.75, 1.1)


def shop_shape(m, u, v):
    """Things on display: dark shapes low down, bright wall and lamps above."""
    cell = m.n('TexVoronoi', {'distance': 'CHEBYCHEV'}, Vector=along_wall(m), Scale=4.2).outputs['Color']
    cell = m.n('SeparateRGB', Image=cell).outputs[0]
    goods = m.ramp(m.math('SUBTRACT', v, m.math('MULTIPLY', cell, 0.32)), 0.0, 0.06, 0.35, 1.0)
    return m.math('MULTIPLY', goods, m.ramp(v, 0.1, 1.0, 0.55, 1.25))


def lantern_shape(m, u, v):
    """A frosted pane before a burner: 30 at the rim, 200 before the flame, times the stored colour."""
    du, dv = m.math('SUBTRACT', u, 0.5), m.math('SUBTRACT', v, 0.42)
    d2 = m.math('ADD', m.math('MULTIPLY', du, du), m.math('MULTIPLY', dv, dv))
    return m.math('MULTIPLY_ADD', m.math('EXPONENT', m.math('MULTIPLY', d2, -18.0)), 170.0, 30.0)


WALLS = ['ochre', 'cream', 'rose', 'grey', 'sage', 'redbrick', 'brownbrick']


def materials():
    return {
        'asphalt': asphalt('asphalt'), 'paving': paving('paving'),
        'kerb': plain('kerb', (0.2, 0.2, 0.19), 0.5), 'line': plain('line', (0.45, 0.45, 0.42), 0.35),
        'ochre': stucco('ochre', (0.42, 0.29, 0.14)), 'cream': stucco('cream', (0.5, 0.44, 0.34)),
        'rose': stucco('rose', (0.42, 0.24, 0.19)), 'grey': stucco('grey', (0.3, 0.31, 0.33)),
        'sage': stucco('sage', (0.27, 0.32, 0.25)),
        'redbrick': brick('redbrick', (0.3, 0.1, 0.06), (0.2, 0.07, 0.045)),
        'brownbrick': brick('brownbrick', (0.24, 0.15, 0.09), (0.17, 0.1, 0.065)),
        'stone': stucco('stone', (0.42, 0.4, 0.36)), 'frame': plain('frame', (0.35, 0.34, 0.31), 0.5),
        'dark': plain('dark', (0.03, 0.035, 0.035), 0.45), 'slate': plain('slate', (0.05, 0.055, 0.065), 0.55),
        'iron': plain('iron', (0.02, 0.024, 0.022), 0.35, 0.6), 'wood': plain('wood', (0.12, 0.06, 0.03), 0.5),
        'green': plain('green', (0.03, 0.09, 0.06), 0.4), 'wine': plain('wine', (0.13, 0.02, 0.025), 0.4),
        'blue': plain('blue', (0.03, 0.05, 0.12), 0.4), 'cloth': plain('cloth', (0.42, 0.4, 0.36), 0.8, 0.1),
        'red': plain('red', (0.3, 0.02, 0.02), 0.7, 0.1), 'bark': plain('bark', (0.07, 0.055, 0.045), 0.85, 0.2),
        'glass': plain('glass', (0.012, 0.014, 0.018), 0.12, 0.6), 'tyre': plain('tyre', (0.015, 0.015, 0.015), 0.8),
        'alloy': plain('alloy', (0.12, 0.12, 0.125), 0.4, metallic=0.6),
        'paint0': plain('paint0', (0.02, 0.028, 0.05), 0.35, coat=1.0), 'paint1': plain('paint1', (0.16, 0.015, 0.015), 0.35, coat=1.0),
        'paint2': plain('paint2', (0.25, 0.26, 0.27), 0.35, coat=1.0), 'paint3': plain('paint3', (0.02, 0.05, 0.04), 0.35, coat=1.0),
        'reflector': plain('reflector', (0.2, 0.01, 0.01), 0.2), 'plate': plain('plate', (0.5, 0.5, 0.45), 0.4),
        'room': emitter('room', room_shape), 'blind': emitter('blind', blind_shape),
        'shop': emitter('shop', shop_shape), 'lantern': emitter('lantern', lantern_shape),
        'flat': emitter('flat', flat_shape),
    }
