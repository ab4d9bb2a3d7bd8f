"""Renders the raw passes of the demo frames, a night street, with Blender's Cycles.

    blender -b -P render.py -- --raw RAW [--frames 1-20] [--size 640x360] [--samples 36]
                               [--threads 0] [--seed 1] [--blend FILE]
    python3 finish.py --raw RAW --out .

  --raw      folder for the raw passes (full float, a few hundred MB; finish.py turns them into frames)
  --frames   first-last, or a list such as 1,10,20; the sequence itself is always street.sky_camera.FRAMES long
  --size     picture size in pixels
  --samples  paths per pixel
  --threads  CPU threads, 0 for all
  --seed     of the sampling noise; the scene has a fixed seed of its own
  --blend    also save the scene, to look at it in Blender

Everything is modelled in street/, from no other file, and comes out the same on every run.
Written for Blender 3.4; needs nothing but Blender.
"""
import argparse
import json
import math
import os
import sys

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))     # Blender does not put a script's own folder there
import street
from street import lamps
from street.sky_camera import FRAMES, camera_at


def build(args):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    sc = bpy.context.scene
    sc.render.engine = 'CYCLES'
    cam = street.build(sc)
    sc.render.resolution_x, sc.render.resolution_y = args.size
    sc.render.resolution_percentage = 100
    sc.render.image_settings.file_format = 'OPEN_EXR_MULTILAYER'
    sc.render.image_settings.color_depth = '32'
    sc.render.image_settings.exr_codec = 'ZIP'
    sc.render.use_persistent_data = True
    if args.threads:
        sc.render.threads_mode, sc.render.threads = 'FIXED', args.threads
    sc.view_settings.view_transform = 'Standard'
    c = sc.cycles
    c.device = 'CPU'
    c.max_bounces, c.diffuse_bounces, c.glossy_bounces = 1, 1, 1
    c.transmission_bounces = c.volume_bounces = c.transparent_max_bounces = 0
    c.sample_clamp_direct, c.sample_clamp_indirect = 0.0, 1.5
    c.caustics_reflective = c.caustics_refractive = False
    c.blur_glossy = 0.5
    c.use_denoising = False
    c.light_sampling_threshold = 0.03
    c.use_adaptive_sampling = False
    vl = sc.view_layers[0]
    vl.name = 'v'
    for p in ('z', 'normal', 'diffuse_direct', 'diffuse_indirect', 'diffuse_color',
              'glossy_direct', 'glossy_indirect', 'glossy_color', 'emit', 'environment'):
        setattr(vl, 'use_pass_' + p, True)
    return sc, cam


def main():
    ap = argparse.ArgumentParser(prog='render.py')
    ap.add_argument('--raw', required=True)
    ap.add_argument('--frames', default='1-%d' % FRAMES)
    ap.add_argument('--size', default='640x360', type=lambda s: tuple(map(int, s.split('x'))))
    ap.add_argument('--samples', default=36, type=int)
    ap.add_argument('--threads', default=0, type=int)
    ap.add_argument('--seed', default=1, type=int)
    ap.add_argument('--blend')
    args = ap.parse_args(sys.argv[sys.argv.index('--') + 1:] if '--' in sys.argv else [])
    if '-' in args.frames:
        a, b = map(int, args.frames.split('-'))
        frames = range(a, b + 1)
    else:
        frames = map(int, args.frames.split(','))
    os.makedirs(args.raw, exist_ok=True)
    sc, cam = build(args)
    if args.blend:
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(args.blend))
    w, h = args.size
    for f in frames:
        camera_at(cam, f)
        bpy.context.view_layer.update()
        # Beauty, antialiased; then one exact ray through each pixel's centre, because depth must not be averaged.
        for name, spp, filt in (('beauty', args.samples, 1.5), ('centre', 1, 0.01)):
            sc.cycles.samples, sc.cycles.filter_width = spp, filt
            sc.cycles.seed = args.seed * 1000 + f
            sc.render.filepath = os.path.abspath(os.path.join(args.raw, '%s.%04d.exr' % (name, f)))
            bpy.ops.render.render(write_still=True)
        dg = bpy.context.evaluated_depsgraph_get()
        proj = cam.calc_matrix_camera(dg, x=w, y=h)
        view = cam.matrix_world.inverted()
        # Blender's matrices act on columns; EXR stores those that act on rows.
        info = {'worldToCamera': [x for col in view.transposed() for x in col],
                'worldToNDC': [x for col in (proj @ view).transposed() for x in col],
                'vfov': 2 * math.degrees(math.atan(cam.data.sensor_width * h / w / 2 / cam.data.lens)),
                'lamps': lamps.positions()}
        with open(os.path.join(args.raw, 'camera.%04d.json' % f), 'w') as fh:
            json.dump(info, fh)


main()
