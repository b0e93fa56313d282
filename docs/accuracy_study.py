#!/usr/bin/env python3
"""Studies the scenes of this repository under six lamps and writes docs/accuracy-study.md with its plots.

usage: docs/accuracy_study.py build/spectrad out/accuracy [--tables] [SCENE...]

--tables writes anew from what out/accuracy holds and measures nothing.

Where out/accuracy/tolerance.txt is (`build/bench_tolerance --kept > out/accuracy/tolerance.txt`), the settings chosen for
a tolerance are a table as well.

Every number in the tables and every point in the plots comes from the results.csv that `spectrad study` leaves in
out/accuracy/SCENE; a study that was stopped goes on. Pictures are small (160 pixels on the longer side): what bands
do to colours does not depend on it."""
import csv
import math
import os
import re
import subprocess
import sys

LAMPS = ['A', 'D65', 'FL11', 'LED-B3', 'HP1', 'FL3.15']
SCENES = ['colorchecker', 'paper/figure2', 'paper/figure3', 'paper/figure4', 'fluorescence', 'still-life', 'gloss-ladder',
          'metal-ladder', 'textured', 'relief', 'pavilion']
SIDE = 160
BUDGET = '100s'
ROWS = [('slit-5nm', 'slit, 5 nm'), ('slit-10nm', 'slit, 10 nm'), ('slit-20nm', 'slit, 20 nm'),
        ('point-5nm', 'point, 5 nm'), ('point-10nm', 'point, 10 nm'), ('point-20nm', 'point, 20 nm'),
        ('rgb', 'RGB'), ('xyz', 'XYZ products'), ('gauss-4', 'Gauss, 4'), ('gauss-10', 'Gauss, 10'),
        ('adaptive-10', 'adaptive, 10'), ('adaptive-20', 'adaptive, 20'), ('adaptive-40', 'adaptive, 40'),
        ('linear-3', 'linear model, 3'), ('linear-4', 'linear model, 4'), ('linear-8', 'linear model, 8')]
KNOBS = [('schlick', "Schlick's formula"), ('texture-nearest', 'textures: nearest'), ('texture-mip', 'textures: mip'),
         ('contracted', 'contracted kernels'), ('fast-math', 'fast mathematics'), ('half', 'half floats'),
         ('bits-12', '12 bits'), ('bits-16', '16 bits'), ('bits-20', '20 bits'),
         ('exr-none', 'EXR, none'), ('exr-zips', 'EXR, zips'), ('exr-zip', 'EXR, zip')]
COLOURS = ['#b8860b', '#1f6fb4', '#c0392b', '#2a9d57', '#7d3c98', '#555555']


def size_of(program, scene):
    """The scene's own shape, SIDE pixels on the longer side."""
    import json
    info = json.loads(subprocess.run([program, 'info', scene, '--json'], check=True, capture_output=True, text=True).stdout)
    scale = SIDE / max(info['width'], info['height'])
    return '%dx%d' % (max(1, round(info['width'] * scale)), max(1, round(info['height'] * scale)))


def study(program, scene, folder):
    command = [program, 'study', scene, '-o', folder, '--size', size_of(program, scene), '--budget', BUDGET, '-q']
    for lamp in LAMPS:
        command += ['--light', 'illuminants/' + lamp]
    subprocess.run(command, check=True)


def read(folder):
    """{setting: {lamp: row}}"""
    rows = {}
    with open(os.path.join(folder, 'results.csv'), encoding='utf-8') as file:
        for row in csv.DictReader(file):
            rows.setdefault(row['setting'], {})[row['light'].split('/')[-1]] = row
    return rows


def short(text):
    value = float(text)
    if value < 1e-4:
        return '< 0.0001' if value > 0 else '0'
    return '%.2g' % value if value < 100 else '%.0f' % value


def cell(row):
    return '–' if row is None else short(row['deltae00_mean']) + ' / ' + short(row['deltae00_max'])


def table(rows, settings):
    lines = ['| | ' + ' | '.join(LAMPS) + ' |', '|---' * (len(LAMPS) + 1) + '|']
    for key, label in settings:
        if key in rows:
            lines.append('| %s | ' % label + ' | '.join(cell(rows[key].get(lamp)) for lamp in LAMPS) + ' |')
    return '\n'.join(lines) + '\n'


def knob_table(rows):
    """The scene under D65 with slit bands of 5 nm: colours, the error of the bands themselves, the file. (Times are in
    results.csv; they mean something on a machine without other work.)"""
    base = rows.get('slit-5nm', {}).get('D65')
    lines = ['| D65, slit, 5 nm | ΔE00 mean / largest | largest band error | file |', '|---|---|---|---|']
    for key, label in [('slit-5nm', 'as it is')] + KNOBS:
        row = rows.get(key, {}).get('D65')
        if row is None:
            continue
        file = '–' if row['file_bytes'] == '0' else '× %.2f' % (float(row['file_bytes']) / float(base['file_bytes']))
        band = '–' if not row['band_relative_max'] else short(row['band_relative_max'])
        lines.append('| %s | %s | %s | %s |' % (label, cell(row), band, file))
    return '\n'.join(lines) + '\n' if base and len(lines) > 3 else ''


def tolerance_table(path):
    """Bands, samples of what was chosen for 1.0 and for 0.2."""
    chosen, kept, all_cases = {}, 0, 0
    with open(path, encoding='utf-8') as file:
        for line in file:
            match = re.match(r'(\S+), (\S+), (1\.0|0\.2): (\d+) (\d+) (\w+) \| (\S+) \|', line)
            if not match:
                continue
            scene, lamp, bound, bands, samples, form, error = match.groups()
            chosen.setdefault(scene, {})[lamp, bound] = bands + ', ' + samples + (' f' if form == 'float' else '')
            all_cases += 1
            kept += float(error) <= float(bound)
    lines = ['## What `--tolerance` chooses\n',
             'Bands and samples a pixel at 150 × 100 pixels, for 99 %% of the pixels within ΔE00 1.0 and within 0.2; halves unless '
             '`f` is said. Judged apart from the chooser – the image\'s own bands and samples against every nanometre with 64 '
             'samples – the bound is kept in %d of %d cases.\n' % (kept, all_cases),
             '| | ' + ' | '.join(LAMPS) + ' |', '|---' * (len(LAMPS) + 1) + '|']
    for scene, of in chosen.items():
        lines.append('| %s | ' % scene + ' | '.join('%s / %s' % (of.get((lamp, '1.0'), '–'), of.get((lamp, '0.2'), '–')) for lamp in LAMPS) + ' |')
    return '\n'.join(lines) + '\n'


def svg(title, rows, wanted, path):
    """ΔE00 that 99 % of the pixels are within, over the number of bands; a line for each lamp, both axes logarithmic."""
    width, height, left, bottom = 640, 380, 60, 46
    lines = []
    for lamp in LAMPS:
        points = sorted((int(row[lamp]['bands']), max(1e-3, float(row[lamp]['deltae00_p99'])))
                        for key, row in rows.items() if wanted(key) and lamp in row)
        lines.append(points)
    every = [p for points in lines for p in points]
    if len({p[0] for p in every}) < 3:  # no curve
        return False
    low, high = math.log10(min(p[0] for p in every)), math.log10(max(p[0] for p in every))
    x = lambda bands: left + (width - left - 90) * (math.log10(bands) - low) / max(1e-9, high - low)
    y = lambda error: 30 + (height - bottom - 30) * (2 - math.log10(min(error, 100))) / 5
    out = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %d %d" font-family="sans-serif" font-size="12">' % (width, height),
           '<rect width="%d" height="%d" fill="white"/><text x="%d" y="18" font-size="14">%s</text>' % (width, height, left, title)]
    for power in range(-3, 3):
        at = y(10.0 ** power)
        out.append('<path d="M%d %.1fH%d" stroke="#ddd"/><text x="%d" y="%.1f" text-anchor="end">%s</text>' %
                   (left, at, width - 90, left - 6, at + 4, '%g' % 10.0 ** power if power > -3 else '≤ 0.001'))
    for bands in (3, 5, 10, 20, 40, 80, 160, 320):
        if low <= math.log10(bands) <= high:
            out.append('<path d="M%.1f 30V%d" stroke="#eee"/><text x="%.1f" y="%d" text-anchor="middle">%d</text>' %
                       (x(bands), height - bottom, x(bands), height - bottom + 16, bands))
    out.append('<text x="%d" y="%d">bands</text><text x="14" y="%d" transform="rotate(-90 14 %d)">ΔE00, 99 %% within</text>' %
               (width // 2 - 40, height - 10, height // 2 + 50, height // 2 + 50))
    for index, (lamp, points) in enumerate(zip(LAMPS, lines)):
        colour = COLOURS[index]
        trace = ' '.join('%.1f,%.1f' % (x(b), y(e)) for b, e in points)
        out.append('<polyline points="%s" fill="none" stroke="%s" stroke-width="2"/>' % (trace, colour))
        out += ['<circle cx="%.1f" cy="%.1f" r="3" fill="%s"/>' % (x(b), y(e), colour) for b, e in points]
        out.append('<rect x="%d" y="%d" width="12" height="4" fill="%s"/><text x="%d" y="%d">%s</text>' %
                   (width - 82, 40 + 18 * index, colour, width - 66, 46 + 18 * index, lamp))
    with open(path, 'w', encoding='utf-8') as file:
        file.write('\n'.join(out) + '\n</svg>\n')
    return True


def main():
    program, out = os.path.abspath(sys.argv[1]), sys.argv[2]
    measure = '--tables' not in sys.argv[3:]
    names = [name for name in sys.argv[3:] if name != '--tables'] or SCENES
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    parts = ['# Every scene under six lamps: the tables\n',
             'Written by [accuracy_study.py](accuracy_study.py) (`make accuracy`) from what `spectrad study` measured, '
             '%d pixels on the longer side, every lamp of the scene replaced by the one above; what it means is in '
             '[accuracy.md](accuracy.md). Figures are ΔE00, mean / largest of all pixels, against every nanometre from '
             '360 to 830 nm with as many samples (filters of textures: against 64). A dash, and a row that is missing: beyond the time that the scene was given (%s, twice where it takes long).\n' % (SIDE, BUDGET)]
    tolerance = os.path.join(out, 'tolerance.txt')
    if os.path.exists(tolerance):
        parts.append(tolerance_table(tolerance))
    for name in names:
        folder = os.path.join(out, name.replace('/', '-'))
        if measure:
            study(program, os.path.join(root, 'scenes', name + '.xml'), folder)
        rows = read(folder)
        parts.append('## %s\n' % name)
        for kind, label in (('slit', 'slit bands'), ('point', 'point samples')):
            image = 'bands-%s-%s.svg' % (name.split('/')[-1], kind)
            if svg('%s: %s' % (name, label), rows, lambda key: key.startswith(kind + '-'), os.path.join(root, 'docs', 'images', image)):
                parts.append('![ΔE00 over the number of bands, %s](images/%s)' % (label, image))
        parts += ['', table(rows, ROWS), knob_table(rows)]
    with open(os.path.join(root, 'docs', 'accuracy-study.md'), 'w', encoding='utf-8') as file:
        file.write('\n'.join(parts))


if __name__ == '__main__':
    main()
