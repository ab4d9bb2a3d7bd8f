"""Makes the demo frames from the raw passes of render.py: removes the noise and packs the files.

    python3 finish.py --raw RAW --out . [--frames 1-20] [--first 1] [--last 20] [--jobs 2]

Needs numpy and OpenImageIO's Python module (Debian: python3-numpy, python3-openimageio).

Noise.  Debian's Blender has no denoiser, so this one works on the separate passes:
  * Light that is emitted (lamps, windows, signs, sky) has no noise and stays as rendered.
  * Diffuse light does not depend on where the camera stands and nothing in the street moves, so every
    frame's irradiance is gathered from all frames that see the same point; a small filter guided by
    depth and normal takes the rest.
  * Mirrored light does depend on the camera: only the nearest frames help, and a larger filter guided
    by depth, normal, albedo and the light itself.
Albedo is divided out before and multiplied back after, so texture stays sharp.
"""
import argparse
import json
import multiprocessing
import os

os.environ.setdefault('OPENBLAS_NUM_THREADS', '1')      # the frames run side by side already

import numpy as np
import OpenImageIO as oiio

FPS = 12
FEATURES = {1, 5, 9, 13, 17}     # frames that carry normals and albedo too
ZMAX = 1e9                       # Blender's depth where there is nothing is 1e10


def read(path):
    b = oiio.ImageBuf(path)
    px, names = b.get_pixels(oiio.FLOAT), list(b.spec().channelnames)
    return lambda p, c='RGB': px[..., [names.index('v.%s.%s' % (p, k)) for k in c]]


class Frame:
    def __init__(self, raw, f):
        b, c = read('%s/beauty.%04d.exr' % (raw, f)), read('%s/centre.%04d.exr' % (raw, f))
        self.diff, self.dc = b('DiffDir') + b('DiffInd'), b('DiffCol')
        self.gloss, self.gc = b('GlossDir') + b('GlossInd'), b('GlossCol')
        self.fixed = b('Emit') + b('Env')
        self.z, self.n, self.albedo = c('Depth', 'Z')[..., 0], c('Normal', 'XYZ'), c('DiffCol')
        self.cam = json.load(open('%s/camera.%04d.json' % (raw, f)))
        self.view = np.array(self.cam['worldToCamera']).reshape(4, 4)      # row vectors: p_camera = p * view
        self.ndc = np.array(self.cam['worldToNDC']).reshape(4, 4)
        h, w = self.z.shape
        y, x = np.mgrid[0:h, 0:w]
        # Pixel centre and planar depth to world position.  proj[0][0] is 1 / tan(half angle).
        proj = np.linalg.inv(self.view) @ self.ndc
        z = np.minimum(self.z, ZMAX).astype(np.float64)
        cx = ((x + 0.5) / w * 2 - 1) / proj[0, 0] * z
        cy = (1 - (y + 0.5) / h * 2) / proj[1, 1] * z
        self.pos = (np.stack([cx, cy, -z, np.ones_like(z)], -1) @ np.linalg.inv(self.view))[..., :3].astype(np.float32)


def tame(x, keep=2.0):
    """No pixel brighter than twice the third brightest of the 5 x 5 around it: removes fireflies."""
    lum = x.max(-1)
    p = np.pad(lum, 2, mode='edge')
    h, w = lum.shape
    win = np.stack([p[i:i + h, j:j + w] for i in range(5) for j in range(5)])
    third = np.partition(win, -3, 0)[-3]
    return x * np.minimum(1.0, keep * third / np.maximum(lum, 1e-9))[..., None]


def gather(fr, others, field):
    """Mean over all frames of a field, each looked up where this frame's points fall in it."""
    h, w = fr.z.shape
    acc, n = getattr(fr, field).copy(), np.ones((h, w, 1), np.float32)
    p = np.concatenate([fr.pos, np.ones((h, w, 1), np.float32)], -1)
    for g in others:
        q = p @ g.ndc
        ok = q[..., 3] > 0.1
        k = np.where(ok, q[..., 3], 1.0)
        x = np.floor((q[..., 0] / k * 0.5 + 0.5) * w).astype(int)
        y = np.floor((0.5 - q[..., 1] / k * 0.5) * h).astype(int)
        ok &= (x >= 0) & (x < w) & (y >= 0) & (y < h) & (fr.z < ZMAX)
        x, y = np.clip(x, 0, w - 1), np.clip(y, 0, h - 1)
        # The same surface: the other frame's point must lie in this point's plane, and close by.
        d = g.pos[y, x] - fr.pos
        plane = np.abs((d * fr.n).sum(-1))
        ok &= (plane < 0.02 + 0.002 * fr.z) & ((d * d).sum(-1) < (0.05 + 0.02 * fr.z) ** 2)
        ok &= (g.n[y, x] * fr.n).sum(-1) > 0.9
        wt = ok[..., None].astype(np.float32)
        acc += getattr(g, field)[y, x] * wt
        n += wt
    return acc / n


def guided(fr, x, radius, tone, albedo, step=1):
    """Joint bilateral filter; tone is the width in the logarithm of the light itself."""
    h, w = fr.z.shape
    R = radius * step

    def pad(a):
        return np.pad(a, [(R, R), (R, R)] + [(0, 0)] * (a.ndim - 2), mode='edge')

    def blur(a):
        p = np.pad(a, [(1, 1), (1, 1), (0, 0)], mode='edge')
        k = (0.25, 0.5, 0.25)
        p = sum(k[i] * p[i:i + h] for i in range(3))
        return sum(k[i] * p[:, i:i + w] for i in range(3))

    guide = np.log(blur(x).mean(-1) + 0.02)
    pos, nor, dc = fr.pos, fr.n, np.sqrt(np.maximum(fr.albedo, 0))
    P, N, D, G, X = pad(pos), pad(nor), pad(dc), pad(guide), pad(x)
    Z = pad(np.minimum(fr.z, ZMAX))
    acc, tot = np.zeros_like(x), np.zeros((h, w), np.float32)
    tol = 0.015 + 0.0015 * np.minimum(fr.z, 1e4)
    for j in range(-R, R + 1, step):
        for i in range(-R, R + 1, step):
            s = (slice(R + j, R + j + h), slice(R + i, R + i + w))
            e = (i * i + j * j) / (0.6 * R) ** 2 * 0.5
            e = e + (((P[s] - pos) * nor).sum(-1) / tol) ** 2
            e += np.maximum(0, 1 - (N[s] * nor).sum(-1)) * 30
            e += ((G[s] - guide) / tone) ** 2
            if albedo:
                e += ((D[s] - dc) ** 2).sum(-1) / albedo ** 2
            wt = np.exp(-e) * (Z[s] < ZMAX)
            acc += X[s] * wt[..., None]
            tot += wt
    return np.where(tot[..., None] > 1e-6, acc / np.maximum(tot, 1e-6)[..., None], x)


def soften_edges(fr, x, col):
    """On outlines a pixel holds two surfaces, and the filters picked one.  The mean of the 3 x 3 around,
    weighted by albedo as the pass itself is, brings the antialiasing back."""
    h, w = fr.z.shape
    p = np.pad(fr.pos, [(1, 1), (1, 1), (0, 0)], mode='edge')
    n = np.pad(fr.n, [(1, 1), (1, 1), (0, 0)], mode='edge')
    X, C = (np.pad(a, [(1, 1), (1, 1), (0, 0)], mode='edge') for a in (x, col + 1e-4))
    edge = np.zeros((h, w), bool)
    acc, tot = np.zeros_like(x), np.zeros_like(x)
    for j in range(3):
        for i in range(3):
            s = (slice(j, j + h), slice(i, i + w))
            edge |= np.abs(((p[s] - fr.pos) * fr.n).sum(-1)) > 0.03 + 0.004 * np.minimum(fr.z, 1e4)
            edge |= (n[s] * fr.n).sum(-1) < 0.8
            g = (0.25, 0.5, 0.25)[j] * (0.25, 0.5, 0.25)[i] * C[s]
            acc += g * X[s]
            tot += g
    return np.where(edge[..., None], acc / tot, x)


def denoise(fr, frames, at):
    e = gather(fr, [g for i, g in enumerate(frames) if i != at], 'diff')
    e = guided(fr, e, 3, 0.5, None)
    e = guided(fr, e, 2, 0.3, None)
    s = gather(fr, [frames[i] for i in range(at - 3, at + 4) if i != at and 0 <= i < len(frames)], 'gloss')
    s = guided(fr, tame(s), 5, 0.8, 0.1)
    s = guided(fr, s, 3, 0.5, 0.1)
    e, s = soften_edges(fr, e, fr.dc), soften_edges(fr, s, fr.gc)
    return e * fr.dc + s * fr.gc + fr.fixed


def save(path, fr, f, rgb):
    h, w = fr.z.shape
    # Depth keeps 14 bits of mantissa (1 mm at 30 m), normals and albedo steps of 1/512: the digits
    # below are rounding, which no ZIP can squeeze.
    z = fr.z.astype(np.float32)
    q = ((z.view(np.uint32) + 0x100) & ~np.uint32(0x1ff)).view(np.float32)
    z = np.where(z > ZMAX, z, q)
    names, types = list('RGBAZ'), ['half'] * 4 + ['float']
    data = [np.minimum(rgb, 65000), np.ones((h, w, 1)), z[..., None]]
    if f in FEATURES:
        names += ['normal.' + c for c in 'XYZ'] + ['albedo.' + c for c in 'RGB']
        types += ['half'] * 6
        data += [np.round(fr.n * 512) / 512, np.round(fr.albedo * 512) / 512]
    spec = oiio.ImageSpec(w, h, len(names), oiio.FLOAT)
    spec.channelnames = names
    spec.channelformats = tuple(oiio.TypeDesc(t) for t in types)
    spec.alpha_channel, spec.z_channel = 3, 4
    spec.attribute('compression', 'zip:9')
    spec.attribute('worldtocamera', oiio.TypeDesc('matrix'), tuple(fr.cam['worldToCamera']))
    spec.attribute('worldToNDC', oiio.TypeDesc('matrix'), tuple(fr.cam['worldToNDC']))
    spec.attribute('camera_vertical_fov', float(fr.cam['vfov']))
    spec.attribute('framesPerSecond', oiio.TypeDesc('rational'), (FPS, 1))
    spec.attribute('DateTime', 0)      # else OpenImageIO writes the time of day as capDate
    spec.attribute('ImageDescription', 'Brume demo, BSD-3-Clause')
    out = oiio.ImageOutput.create(path)
    if not out.open(path, spec) or not out.write_image(np.ascontiguousarray(np.concatenate(data, -1), np.float32)):
        raise SystemExit(out.geterror())
    out.close()


def one(at):
    return denoise(frames[at], frames, at)


def main():
    ap = argparse.ArgumentParser()
    ap.add_argument('--raw', required=True)
    ap.add_argument('--out', default='.')
    ap.add_argument('--frames', default='1-20', help='frames to gather light from')
    ap.add_argument('--first', type=int, help='frames to write, by default all')
    ap.add_argument('--last', type=int)
    ap.add_argument('--jobs', type=int, default=2)
    args = ap.parse_args()
    if '-' in args.frames:
        a, b = map(int, args.frames.split('-'))
        numbers = list(range(a, b + 1))
    else:
        numbers = list(map(int, args.frames.split(',')))
    global frames
    frames = [Frame(args.raw, f) for f in numbers]
    todo = [i for i, f in enumerate(numbers) if (args.first or f) <= f <= (args.last or f)]
    # Forked, so that the frames are shared.  Files are written here: OpenImageIO's threads do not survive a fork.
    with multiprocessing.get_context('fork').Pool(args.jobs) as pool:
        for i, rgb in zip(todo, pool.imap(one, todo, 1)):
            path = '%s/street.%04d.exr' % (args.out, numbers[i])
            save(path, frames[i], numbers[i], rgb)
            print(path, os.path.getsize(path), flush=True)


if __name__ == '__main__':
    main()
