#!/usr/bin/env python3
"""Plots what white surfaces lose in a white furnace over their roughness: docs/images/furnace-loss.svg.

usage: docs/furnace_curve.py build/spectrad

Renders spheres in uniform light of radiance 1 and takes the largest |1 - radiance| of all pixels of each; beside it
the share of light that bounces more than once between facets, which a model without compensation loses
(`spectrad info`)."""
import array
import json
import math
import os
import subprocess
import sys
import tempfile

STEPS = [i / 20 for i in range(1, 21)]
CELL = 40  # pixels a sphere
WHITE = '<diffuse reflectance="constant:1"/>'
MODELS = [
    ('metal (n = 10⁻⁵, k = 100)', '#b8860b', '<conductor ior="perfect.csv" roughness="{0}"/>'),
    ('coat n = 1.5 on white', '#1f6fb4', WHITE + '<gloss ior="1.5" roughness="{0}"/>'),
    ('dispersive coat on white', '#2a9d57', WHITE + '<gloss ior="cauchy:1.6,0.02" roughness="{0}"/>'),
    ('brushed metal, 5 to 1', '#c0392b', '<conductor ior="perfect.csv" roughness="{0} {1}"/>'),
]


def scene(lobes):
    text = '<scene version="1"><wavelengths>420 550 680</wavelengths>\n'
    for i, r in enumerate(STEPS):
        text += f'<material name="m{i}">{lobes.format(f"{r:.6g}", f"{r / 5:.6g}")}</material>\n'
        text += f'<node translate="{i + 0.5} 0 0"><sphere radius="0.5" material="m{i}"/></node>\n'
    half = len(STEPS) / 2
    return text + f'''<light type="ambient" spectrum="constant:1" scale="1"/>
<background spectrum="constant:1" scale="1"/>
<camera type="orthographic" height="1" look-from="{half} 0 5" look-at="{half} 0 0" size="{CELL * len(STEPS)}x{CELL}"/></scene>'''


def measure(program, folder, lobes):
    """Largest deviation from 1 and share that bounces, a roughness each."""
    path = os.path.join(folder, 'furnace.xml')
    with open(path, 'w', encoding='utf-8') as file:
        file.write(scene(lobes))
    image = os.path.join(folder, 'furnace.img')
    subprocess.run([program, 'render', path, '-o', image, '--quiet'], check=True)
    values = array.array('f')
    with open(image, 'rb') as file:
        values.frombytes(file.read())
    if sys.byteorder == 'big':
        values.byteswap()  # ENVI files of ours are little endian, [row][band][x]
    width = CELL * len(STEPS)
    worst = [0.0] * len(STEPS)
    for i, value in enumerate(values):
        sphere = i % width // CELL
        worst[sphere] = max(worst[sphere], abs(1 - value))
    told = json.loads(subprocess.run([program, 'info', path, '--json', '--quiet'], check=True, stdout=subprocess.PIPE).stdout)
    bouncing = [m['furnace']['bouncing'] for m in told['material_reports'] if m['name'].startswith('m') and 'furnace' in m]
    return worst, bouncing[:len(STEPS)]


def svg(curves):
    left, top, width, height, low = 62, 16, 520, 300, -8
    def at(r, value):
        decade = max(math.log10(value) if value > 0 else low, low)
        return f'{left + r * width:.1f},{top + height * decade / low:.1f}'
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{left + width + 230}" height="{top + height + 44}" '
           'font-family="sans-serif" font-size="12" fill="#222">',
           '<rect width="100%" height="100%" fill="#fff"/>']
    for decade in range(0, low - 1, -1):
        y = top + height * decade / low
        out.append(f'<path d="M{left} {y:.1f}h{width}" stroke="#ddd"/><text x="{left - 8}" y="{y + 4:.1f}" text-anchor="end">10'
                   f'<tspan dy="-4" font-size="9">{decade}</tspan></text>')
    y = top + height * -2 / low
    out.append(f'<path d="M{left} {y:.1f}h{width}" stroke="#c33" stroke-dasharray="2 3"/>'
               f'<text x="{left + 6}" y="{y - 4:.1f}" fill="#c33">1 %</text>')
    for r in (0, 0.2, 0.4, 0.6, 0.8, 1):
        out.append(f'<text x="{left + r * width:.1f}" y="{top + height + 18}" text-anchor="middle">{r}</text>')
    out.append(f'<text x="{left + width / 2}" y="{top + height + 36}" text-anchor="middle">roughness</text>')
    for row, (name, colour, worst, bouncing) in enumerate(curves):
        for values, dash in ((worst, ''), (bouncing, ' stroke-dasharray="6 4"')):
            points = ' '.join(at(r, v) for r, v in zip(STEPS, values))
            out.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.6"{dash}/>')
        y = top + 16 + 20 * row
        out.append(f'<path d="M{left + width + 14} {y - 4}h24" stroke="{colour}" stroke-width="1.6"/>'
                   f'<text x="{left + width + 44}" y="{y}">{name}</text>')
    y = top + 26 + 20 * len(curves)
    for dash, words in (('', 'lost or gained, at most'), (' stroke-dasharray="6 4"', 'bouncing between facets')):
        out.append(f'<path d="M{left + width + 14} {y - 4}h24" stroke="#444" stroke-width="1.6"{dash}/>'
                   f'<text x="{left + width + 44}" y="{y}">{words}</text>')
        y += 20
    return '\n'.join(out + ['</svg>', ''])


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    curves = []
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, 'perfect.csv'), 'w', encoding='ascii') as file:
            file.write('wavelength_nm,n,k\n300,0.00001,100\n900,0.00001,100\n')
        for name, colour, lobes in MODELS:
            worst, bouncing = measure(os.path.abspath(sys.argv[1]), folder, lobes)
            print(f'{name}: at most {max(worst):.1e} lost or gained, up to {max(bouncing):.2f} bouncing between facets')
            curves.append((name, colour, worst, bouncing))
    target = os.path.join(os.path.dirname(os.path.abspath(__file__)), 'images', 'furnace-loss.svg')
    with open(target, 'w', encoding='utf-8') as file:
        file.write(svg(curves))


main()
