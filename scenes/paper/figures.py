#!/usr/bin/env python3
"""The paper's figures 2 to 5: figures.py [SPECTRAD] [OUT]   (make figures)

Renders the scenes beside this script under every lamp and for every detector, puts the panels of a figure into one picture,
OUT/figureN.png, and measures: OUT/differences.csv and OUT/differences.md. Halves are measured left and right of the seam in the
rendered cubes. Shading is one factor for all wavelengths, so for eyes and cameras the right half is scaled to the left's
luminance before the colours are compared (CIEDE2000); film is not linear, there the two sides of the seam are compared as they are.
"""

import csv
import json
import math
import struct
import subprocess
import sys
import zlib
from pathlib import Path

HERE = Path(__file__).resolve().parent
# Pixels left and right of each animal's seam, of the scenes' own size.
SEAMS = {"elephant": ((192, 130), (212, 130)), "rabbit": ((494, 185), (514, 185)),
         "cow": ((781, 130), (761, 130)), "duck": ((1030, 190), (1010, 190))}
RADIUS = 3
LAMPS = {"D65": "illuminants/D65", "A": "illuminants/A", "fluorescent": "lamps/f32t8-tl841-triphosphor"}
DETECTORS = {"CIE 1931": "cie1931-2", "camera": str(HERE / "figure3.xml#camera"), "film": "generic-reversal"}
BLACK_LIGHT = {"A": "illuminants/A", "D65": "illuminants/D65", "black light": "lamps/uv-365"}
RABBITS = {"plain": (228, 205), "inked": (492, 205)}  # of figure 4


def delta_e00(lab1, lab2):
    """CIEDE2000 (Sharma, Wu, Dalal 2005)."""
    (l1, a1, b1), (l2, a2, b2) = lab1, lab2
    mean = (math.hypot(a1, b1) + math.hypot(a2, b2)) / 2
    g = 0.5 * (1 - math.sqrt(mean**7 / (mean**7 + 25**7)))
    a1, a2 = (1 + g) * a1, (1 + g) * a2
    c1, c2 = math.hypot(a1, b1), math.hypot(a2, b2)
    h1, h2 = math.degrees(math.atan2(b1, a1)) % 360, math.degrees(math.atan2(b2, a2)) % 360
    dh = 0 if c1 * c2 == 0 else (h2 - h1 + 180) % 360 - 180
    hue = h1 + h2 if c1 * c2 == 0 else (h1 + h2) / 2 if abs(h1 - h2) <= 180 else (h1 + h2 + (360 if h1 + h2 < 360 else -360)) / 2
    light, chroma = (l1 + l2) / 2, (c1 + c2) / 2
    cos = lambda degrees: math.cos(math.radians(degrees))
    t = 1 - 0.17 * cos(hue - 30) + 0.24 * cos(2 * hue) + 0.32 * cos(3 * hue + 6) - 0.20 * cos(4 * hue - 63)
    sl = 1 + 0.015 * (light - 50) ** 2 / math.sqrt(20 + (light - 50) ** 2)
    sc, sh = 1 + 0.045 * chroma, 1 + 0.015 * chroma * t
    rt = -2 * math.sqrt(chroma**7 / (chroma**7 + 25**7)) * math.sin(math.radians(60 * math.exp(-(((hue - 275) / 25) ** 2))))
    dl, dc, dh = (l2 - l1) / sl, (c2 - c1) / sc, 2 * math.sqrt(c1 * c2) * math.sin(math.radians(dh / 2)) / sh
    return math.sqrt(dl * dl + dc * dc + dh * dh + rt * dc * dh)


def lab(xyz, white):
    f = [v ** (1 / 3) if v > 216 / 24389 else 841 / 108 * v + 4 / 29 for v in (a / b for a, b in zip(xyz, white))]
    return 116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])


class Program:
    def __init__(self, program, out):
        self.program, self.out = program, out

    def run(self, *arguments):
        done = subprocess.run([self.program, *map(str, arguments)], stdout=subprocess.PIPE, text=True, check=True)
        return done.stdout

    def render(self, scene, name, lights, lamp, *more):
        cube = self.out / f"{name}.exr"
        sets = [a for light in lights for a in ("--set", f"{light}.spectrum={lamp}")]
        self.run("render", HERE / scene, "-o", cube, "-q", *sets, *more)
        return cube

    def picture(self, cube, *arguments):
        target = self.out / f"{cube.stem}.png"
        self.run("observe", cube, "-o", target, "-q", *arguments)
        return target

    def measure(self, cube, places, *arguments):
        at = [a for x, y in places for a in ("--at", f"{x},{y},{RADIUS}")]
        return json.loads(self.run("measure", cube, *at, "--json", "-q", *arguments))


def read_png(path):
    """Width and rows of an 8-bit RGB picture."""
    data, at, packed, width = path.read_bytes(), 8, b"", 0
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
            assert (depth, colour) == (8, 2), path
        if kind == b"IDAT":
            packed += body
        at += size + 12
    raw, stride, rows, before = zlib.decompress(packed), 3 * width, [], bytes(3 * width)
    for y in range(height):
        kind, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left, up, corner = line[i - 3] if i > 2 else 0, before[i], before[i - 3] if i > 2 else 0
            if kind == 1:
                add = left
            elif kind == 2:
                add = up
            elif kind == 3:
                add = (left + up) // 2
            elif kind == 4:
                p = left + up - corner
                add = min((left, up, corner), key=lambda v: abs(p - v))
            else:
                add = 0
            line[i] = (line[i] + add) & 255
        before = bytes(line)
        rows.append(before)
    return width, rows


def write_png(path, width, rows):
    chunk = lambda kind, body: struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0))
                     + chunk(b"sRGB", b"\0") + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows), 9))
                     + chunk(b"IEND", b""))


def plate(target, panels):
    """Panels one below the other, a white line between."""
    rows = []
    for panel in panels:
        width, own = read_png(panel)
        rows += ([b"\xff" * (3 * width)] * 6 if rows else []) + own
    write_png(target, width, rows)


def halves(reading_left, reading_right, film):
    """CIEDE2000 of the two sides of a seam."""
    if film:
        return delta_e00(reading_left["rendered"]["Lab"], reading_right["rendered"]["Lab"])
    seen = lambda reading: reading.get("rendered", reading)["XYZ"]
    left, right = seen(reading_left), seen(reading_right)
    scale = left[1] / right[1]
    white = reading_left["white"]
    return delta_e00(lab(left, white), lab([scale * v for v in right], white))


def white_of(program, cube, detector, floor):
    """What the grey floor beside the animals would be with a reflectance of 1, as that detector's picture has it."""
    reading = program.measure(cube, [floor], "--observer", detector)[0]
    xyz = reading.get("rendered", reading)["XYZ"]
    return [v / 0.45 for v in xyz]


def seam_rows(program, figure, cube, label, detector, rows):
    floor = (600, 285)
    film = detector == "generic-reversal"
    white = white_of(program, cube, detector, floor)
    places = [p for pair in SEAMS.values() for p in pair]
    readings = program.measure(cube, places, "--observer", detector)
    for i, animal in enumerate(SEAMS):
        left, right = readings[2 * i], readings[2 * i + 1]
        left["white"] = white
        rows.append((figure, label, animal, "halves, CIEDE2000", halves(left, right, film)))


def main():
    program = Program(sys.argv[1] if len(sys.argv) > 1 else "build/spectrad", Path(sys.argv[2] if len(sys.argv) > 2 else "out/figures"))
    program.out.mkdir(parents=True, exist_ok=True)
    rows = []

    panels = []
    for label, lamp in LAMPS.items():
        cube = program.render("figure2.xml", f"figure2-{label}", ("key", "fill"), lamp)
        panels.append(program.picture(cube, "--exposure", "0"))
        seam_rows(program, 2, cube, f"{label}, CIE 1931", "cie1931-2", rows)
    plate(program.out / "figure2.png", panels)

    cube, panels = program.render("figure3.xml", "figure3", ("key", "fill"), LAMPS["D65"]), []
    for label, detector in DETECTORS.items():
        picture = program.out / f"figure3-{label.replace(' ', '')}.png"
        program.run("observe", cube, "-o", picture, "-q", "--observer", detector, "--exposure",
                    "0.7" if label == "film" else "0")
        panels.append(picture)
        seam_rows(program, 3, cube, f"D65, {label}", detector, rows)
    plate(program.out / "figure3.png", panels)

    panels, glow = [], {}
    for label, lamp in BLACK_LIGHT.items():
        name = f"figure4-{label.replace(' ', '-')}"
        cube = program.render("figure4.xml", name, ("key", "rim"), lamp)
        dark = program.render("figure4.xml", f"{name}-without", ("key", "rim"), lamp, "--set", "inked.fluorescence.yield=0")
        with_ink, without = (program.measure(c, [RABBITS["inked"]])[0] for c in (cube, dark))
        bright = 2.2 * with_ink["XYZ"][1]  # the glow below the display's white; a black light is no white to adapt to
        white = ("--white", f"{0.9505 * bright},{bright},{1.089 * bright}") if label == "black light" else ("--exposure", "auto")
        panels.append(program.picture(cube, *white))
        glow[label] = sum(a - b for a, b in zip(with_ink["radiance"], without["radiance"])) * 5
        rows.append((4, label, "inked rabbit", "emitted radiance, W.m^-2.sr^-1", glow[label]))
    for label in ("A", "D65"):
        rows.append((4, label, "inked rabbit", "emission / that under the black light, equal irradiance 300 to 780 nm",
                     glow[label] / glow["black light"]))
    plate(program.out / "figure4.png", panels)

    program.picture(program.render("figure5.xml", "figure5", (), ""))

    with open(program.out / "differences.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(("figure", "viewing", "what", "measure", "value"))
        table.writerows((*row[:4], f"{row[4]:.4g}") for row in rows)
    lines = ["| figure | viewing | what | measure | value |", "|---|---|---|---|---|"]
    lines += [f"| {a} | {b} | {c} | {d} | {e:.3g} |" for a, b, c, d, e in rows]
    (program.out / "differences.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(f"plates and differences in {program.out}")


if __name__ == "__main__":
    main()
