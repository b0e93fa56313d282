#!/usr/bin/env python3
"""Writes the relief maps of relief.xml from formulae: heights in units of the map's width, kept as normal maps (as in glTF) where metal or
glaze would show the steps of 8-bit heights, as heights where the surface is matt. All but the medal go on at their borders.

    python3 scenes/make_reliefs.py            # from anywhere: the products lie beside this file, in reliefs/
"""

import math
import pathlib
import random
import struct
import zlib

SIDE = 384  # texels


def write_png(path, side, channels, rows):
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    head = struct.pack('>IIBBBBB', side, side, 8, {1: 0, 3: 2}[channels], 0, 0, 0)
    body = b''.join(b'\x00' + bytes(row) for row in rows)
    path.write_bytes(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', head) + chunk(b'IDAT', zlib.compress(body, 9)) + chunk(b'IEND', b''))


def sampled(height):
    """height(u, v), v upwards, at the texels' centres; row 0 on top."""
    return [[height((x + 0.5) / SIDE, 1 - (y + 0.5) / SIDE) for x in range(SIDE)] for y in range(SIDE)]


def normal_map(height, periodic=True):
    h = sampled(height)
    near = (lambda i: i % SIDE) if periodic else (lambda i: min(max(i, 0), SIDE - 1))
    rows = []
    for y in range(SIDE):
        row = []
        for x in range(SIDE):
            along = (h[y][near(x + 1)] - h[y][near(x - 1)]) * SIDE / 2
            up = (h[near(y - 1)][x] - h[near(y + 1)][x]) * SIDE / 2
            length = math.sqrt(along * along + up * up + 1)
            row += [round((c / length + 1) * 127.5) for c in (-along, -up, 1)]
        rows.append(row)
    return rows


def height_map(height):
    h = sampled(height)
    low, high = min(map(min, h)), max(map(max, h))
    return [[round((v - low) / (high - low) * 255) for v in row] for row in h]


def smoothstep(a, b, x):
    t = min(max((x - a) / (b - a), 0.0), 1.0)
    return t * t * (3 - 2 * t)


def dome(distance, radius):
    """A seed: round, steep at its edge."""
    return math.sqrt(max(0.0, 1 - (distance / radius) ** 2)) * radius


# ---- a sunflower on a medal -----------------------------------------------------------------------------------------------

def sunflower():
    """Vogel's spiral (1979): seed n at √n and n times the golden angle; petals around it, and a ring of beads."""
    golden = math.pi * (3 - math.sqrt(5))
    count, reach = 233, 0.27
    seeds = [(reach * math.sqrt(n / count), n * golden) for n in range(count)]
    seeds = [(r * math.cos(a), r * math.sin(a)) for r, a in seeds]
    cell = 0.04
    grid = {}
    for x, y in seeds:
        grid.setdefault((math.floor(x / cell), math.floor(y / cell)), []).append((x, y))

    def height(u, v):
        x, y = u - 0.5, v - 0.5
        r, a = math.hypot(x, y), math.atan2(y, x)
        value = 0.0
        if r < reach + 0.03:
            size = 0.0145
            i, j = math.floor(x / cell), math.floor(y / cell)
            nearest = min((math.hypot(x - sx, y - sy) for p in (i - 1, i, i + 1) for q in (j - 1, j, j + 1)
                           for sx, sy in grid.get((p, q), ())), default=1.0)
            value = 0.01 * (1 - (r / reach) ** 2) + 0.55 * dome(nearest, size)
        for petals, inner, outer, turn, lift in ((21, 0.262, 0.40, 0.5, 0.0), (21, 0.262, 0.375, 0.0, 0.006)):
            step = 2 * math.pi / petals
            off = ((a / step + turn) % 1 - 0.5) * step * r          # across the petal
            t = (r - inner) / (outer - inner)                       # along it
            if 0 < t < 1:
                half = 0.040 * math.sin(math.pi * min(1.0, 0.30 + 0.70 * t)) ** 0.75 * smoothstep(0, 0.05, t)
                if abs(off) < half:
                    s = off / half
                    crease = 0.0025 * (1 - abs(s)) ** 2
                    value = max(value, lift + 0.016 * math.sqrt(1 - s * s) * (1 - 0.5 * t) - crease)
        beads = 72
        step = 2 * math.pi / beads
        off = ((a / step) % 1 - 0.5) * step * 0.455
        value = max(value, 0.6 * dome(math.hypot(off, r - 0.455), 0.0165))
        return value + 0.012 * smoothstep(0.472, 0.482, r)

    return height


# ---- hammered metal ------------------------------------------------------------------------------------------------------

def hammered():
    """Dents of a round hammer: the lowest of paraboloids around jittered places."""
    cells = 11
    dice = random.Random(3)
    places = {(i, j): (i + 0.15 + 0.7 * dice.random(), j + 0.15 + 0.7 * dice.random(), 0.25 * dice.random())
              for i in range(cells) for j in range(cells)}

    def height(u, v):
        x, y = u * cells, v * cells
        i, j = math.floor(x), math.floor(y)
        low = 9.0
        for p in range(i - 2, i + 3):
            for q in range(j - 2, j + 3):
                px, py, depth = places[p % cells, q % cells]
                px += (p - p % cells)
                py += (q - q % cells)
                low = min(low, (x - px) ** 2 + (y - py) ** 2 + depth)
        return 0.22 * low / cells

    return height


# ---- glazed tiles --------------------------------------------------------------------------------------------------------

def star_tile():
    """The eight-pointed star of two squares, ribbed, in a tile with bevelled edges."""
    def height(u, v):
        x, y = 2 * u - 1, 2 * v - 1
        square = max(abs(x), abs(y))
        turned = (abs(x) + abs(y)) / math.sqrt(2)
        star = min(square, turned)                                  # below 0.62: in either square
        rib = lambda d, width: math.sqrt(max(0.0, 1 - (d / width) ** 2)) * width
        value = 0.30 * max(rib(star - 0.60, 0.075), rib(star - 0.38, 0.06))
        inner = 0.42 * dome(math.hypot(x, y), 0.17)
        corner = 0.42 * dome(math.hypot(abs(x) - 0.80, abs(y) - 0.80), 0.12)
        return max(value, inner, corner) - 0.05 * smoothstep(0.93, 1.0, square)

    return height


# ---- cloth ---------------------------------------------------------------------------------------------------------------

def weave():
    """Plain weave: threads that go over and under each other, round across."""
    threads = 8

    def height(u, v):
        x, y = u * threads, v * threads
        over = 1 if (math.floor(x) + math.floor(y)) % 2 else -1
        along_x = math.sqrt(max(0.0, 1 - (2 * (y % 1) - 1) ** 2)) * 0.6 + 0.5 * over * math.sin(math.pi * (x % 1))
        along_y = math.sqrt(max(0.0, 1 - (2 * (x % 1) - 1) ** 2)) * 0.6 - 0.5 * over * math.sin(math.pi * (y % 1))
        return max(along_x, along_y)

    return height


if __name__ == '__main__':
    folder = pathlib.Path(__file__).parent / 'reliefs'
    folder.mkdir(exist_ok=True)
    write_png(folder / 'sunflower.png', SIDE, 3, normal_map(sunflower(), periodic=False))
    write_png(folder / 'hammered.png', SIDE, 3, normal_map(hammered()))
    write_png(folder / 'star-tile.png', SIDE, 3, normal_map(star_tile()))
    write_png(folder / 'weave.png', SIDE, 1, height_map(weave()))
