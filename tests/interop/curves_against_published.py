#!/usr/bin/env python3
"""How far our formula camera and film lie from published curves: curves_against_published.py SHARED

Prints the root mean square difference of each curve, peak 1, and fails where it is more than what spectra/README.md states
(STATED below). SHARED/data holds the published curves; without them nothing is checked (exit code 77).
"""

import csv
import math
import sys
from pathlib import Path

SPECTRA = Path(__file__).resolve().parents[2] / "spectra"
FILMS = ("kodak_ektachrome_100d", "fuji_provia_100f", "fuji_velvia_50")
# What the README says: root mean square, of the peak (densities of characteristic curves: absolute).
STATED = {"sensor": 0.02, "camera R": 0.18, "camera G": 0.19, "camera B": 0.07, "layer R": 0.07, "layer G": 0.07, "layer B": 0.10,
          "dye C": 0.04, "dye M": 0.04, "dye Y": 0.06, "characteristic": 0.13}


def table(path):
    rows = [row for row in csv.reader(line for line in path.read_text().splitlines() if not line.startswith("#"))]
    return rows[0], sorted([float(v) for v in row] for row in rows[1:])


def curve(rows, column=1):
    return [row[0] for row in rows], [row[column] for row in rows]


def at(nm, x, y, outside=0.0):
    if nm < x[0] or nm > x[-1]:
        return outside
    for k in range(1, len(x)):
        if nm <= x[k]:
            return y[k - 1] + (y[k] - y[k - 1]) * (nm - x[k - 1]) / (x[k] - x[k - 1])
    return y[-1]


def peaked(values):
    top = max(values)
    return [v / top for v in values]


def rms(a, b):
    return math.sqrt(sum((p - q) ** 2 for p, q in zip(a, b, strict=True)) / len(a))


def ours(name, column):
    header, rows = table(SPECTRA / f"{name}.csv")
    return curve(rows, header.index(column))


def film_file():
    lines = (SPECTRA / "films/generic-reversal.film").read_text().splitlines()
    return {words[0]: [float(v) for v in words[1:6]] for words in (line.split("#")[0].split() for line in lines)
            if words and words[0] in ("red", "green", "blue")}


def main():
    data = Path(sys.argv[1]) / "data"
    if not data.is_dir():
        print(f"skipped: no published curves at {data}")
        return 77
    found = {}

    def say(name, value):
        found[name] = max(found.get(name, 0), value)

    nm = [400 + 5 * k for k in range(81)]
    qe = curve(table(data / "camera/qe_typical_ccd.csv")[1])
    say("sensor", rms(peaked([at(x, *ours("sensors/ccd", "qe")) for x in nm]), peaked([at(x, *qe) for x in nm])))
    # Wratten 29, 61, 47 hold densities; the same sensor and our infrared cut before them.
    cut = ours("filters/ir-cut", "transmittance")
    for channel, wratten in (("R", "W29"), ("G", "W61"), ("B", "W47")):
        density = curve(table(data / f"filters/wratten2/{wratten}.csv")[1])
        published = [at(x, *qe) * x * at(x, *cut) * 10 ** -at(x, *density, outside=4.0) for x in nm]
        say(f"camera {channel}", rms(peaked([at(x, *ours("cameras/dcs200-like", channel)) for x in nm]), peaked(published)))
    for film in FILMS:
        folder = data / "film" / film
        for layer, colour in (("R", "red"), ("G", "green"), ("B", "blue")):
            x, y = curve(table(folder / f"log_sensitivity_{colour}.csv")[1])
            grid = [390 + 2 * k for k in range(155)]
            published = [10 ** at(g, x, y, outside=-9.0) for g in grid]
            say(f"layer {layer}", rms(peaked([at(g, *ours("films/generic-reversal-layers", layer)) for g in grid]),
                                      peaked(published)))
        for dye, colour in (("C", "cyan"), ("M", "magenta"), ("Y", "yellow")):
            x, y = curve(table(folder / f"dye_density_{colour}.csv")[1])
            grid = [400 + 5 * k for k in range(60)]
            say(f"dye {dye}", rms(peaked([at(g, *ours("films/generic-reversal-dyes", dye)) for g in grid]),
                                  peaked([at(max(x[0], min(x[-1], g)), x, y) for g in grid])))
        for colour, (dmin, dmax, slope, centre, shoulder) in film_file().items():
            x, y = curve(table(folder / f"characteristic_{colour}.csv")[1])
            density = lambda lg: dmin + (dmax - dmin) * (1 + 10 ** (slope * (lg - centre))) ** -shoulder
            # Films differ in speed: the exposure scale is moved to where the densities of 1 meet.
            crossing = next(a + (b - a) * (1 - p) / (q - p) for a, b, p, q in zip(x, x[1:], y, y[1:]) if (p - 1) * (q - 1) <= 0)
            own = min((k / 1000 for k in range(-1000, 1000)), key=lambda lg: abs(density(lg) - 1))
            rows = [(g, d) for g, d in zip(x, y) if 0.3 < d < 2.5]
            say("characteristic", rms([density(g - crossing + own) for g, _ in rows], [d for _, d in rows]))
    bad = 0
    for name, value in found.items():
        print(f"{name:16} {value:.3f}  (stated: up to {STATED[name]})")
        bad += value > STATED[name]
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
