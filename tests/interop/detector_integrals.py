#!/usr/bin/env python3
"""Our integrals of light x reflectance x detector against colour-science's tables: detector_integrals.py TEST_CAMERA

For every observer and camera of the library that the package has, 24 ColorChecker patches under A, D65 and FL11: the package's
tables, linear between their samples, by Simpson's rule on half nanometres, which is exact for the cubic pieces. Relative to
the detector's largest channel within 1e-6. Exit code 77: colour-science is not installed, nothing was checked.
"""

import os
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

try:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import colour
        import numpy as np
except ImportError as missing:
    print(f"skipped: {missing} (pip install colour-science)")
    sys.exit(77)

TOLERANCE = 1e-6
CMFS = {
    "cie1931-2": "CIE 1931 2 Degree Standard Observer", "cie1964-10": "CIE 1964 10 Degree Standard Observer",
    "cie2015-2": "CIE 2015 2 Degree Standard Observer", "cie2015-10": "CIE 2015 10 Degree Standard Observer",
    "stockman-sharpe-2": "Stockman & Sharpe 2 Degree Cone Fundamentals",
    "stockman-sharpe-10": "Stockman & Sharpe 10 Degree Cone Fundamentals",
}
LEFS = {
    "cie1924-photopic": "CIE 1924 Photopic Standard Observer", "cie1951-scotopic": "CIE 1951 Scotopic Standard Observer",
    "cie2008-photopic-2": "CIE 2008 2 Degree Physiologically Relevant LEF",
    "cie2008-photopic-10": "CIE 2008 10 Degree Physiologically Relevant LEF",
}
CAMERAS = {"nikon-5100": "Nikon 5100 (NPL)", "sigma-sd-merrill": "Sigma SDMerill (NPL)"}
GRID = np.arange(300, 830.25, 0.5)


def on_grid(sd, held=False):
    ends = {} if held else {"left": 0, "right": 0}
    return np.interp(GRID, sd.wavelengths, sd.values, **ends)


def simpson(values):
    # One piece a nanometre. A table that ends between zero and its first value jumps there: the half nanometre outside is zero,
    # so pieces that straddle an end are none of its own; tables here begin and end on whole nanometres.
    return (values[:-2:2] + 4 * values[1:-1:2] + values[2::2]).sum() / 6


def detectors():
    fundamentals = colour.MSDS_CMFS["Stockman & Sharpe 2 Degree Cone Fundamentals"]
    for name, key in CMFS.items():
        yield f"observers/{name}", [colour.MSDS_CMFS[key].to_sds()[c] for c in range(3)]
    for name, key in LEFS.items():
        yield f"observers/{name}", [colour.SDS_LEFS[key]]
    for name, key in CAMERAS.items():
        yield f"cameras/{name}", colour.MSDS_CAMERA_SENSITIVITIES[key].to_sds()
    # The package's own model of anomalous trichromats; their cones as X Y Z by CIE 170-2.
    matrix = np.array([[1.94735469, -1.41445123, 0.36476327], [0.68990272, 0.34832189, 0], [0, 0, 1.93485343]])
    for name, shift in (("protanomalous-10", (10, 0, 0)), ("deuteranomalous-10", (0, 10, 0))):
        lms = colour.blindness.msds_cmfs_anomalous_trichromacy_Machado2009(fundamentals, np.array(shift))
        xyz = lms.values @ matrix.T
        yield f"observers/{name}", [colour.SpectralDistribution(xyz[:, k], lms.wavelengths) for k in range(3)]


def trapezoid_jumps(response, light):
    """What Simpson's rule adds where a table starts or ends with a jump: nothing lies outside."""
    total = np.zeros(len(GRID))
    inside = (GRID >= response.wavelengths[0]) & (GRID <= response.wavelengths[-1])
    inside &= (GRID >= light.wavelengths[0]) & (GRID <= light.wavelengths[-1])
    total[inside] = 1
    first, last = np.flatnonzero(inside)[[0, -1]]
    return first, last


def main():
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "integrals.csv"
        subprocess.run([sys.argv[1], "[interop-export]"], check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "SPECTRAD_INTEGRALS": str(target)})
        ours = {}
        for line in target.read_text().splitlines():
            name, light, patch, channel, value = line.split(",")
            ours.setdefault((name, light, patch), []).append(float(value))

    chart = list(colour.SDS_COLOURCHECKERS["BabelColor Average"].values())
    patches = list(dict.fromkeys(patch for _, _, patch in ours))
    worst, checked = ("", 0.0), 0
    for name, responses in detectors():
        largest = 0
        for light in ("A", "D65", "FL11"):
            lamp = colour.SDS_ILLUMINANTS[light]
            rows = []
            for index, patch in enumerate(patches):
                values = []
                for response in responses:
                    first, last = trapezoid_jumps(response, lamp)
                    product = on_grid(lamp) * on_grid(chart[index], held=True) * on_grid(response)
                    values.append(simpson(product[first:last + 1]))
                rows.append((patch, values))
            scale = max(max(values) for _, values in rows)
            for patch, values in rows:
                for mine, theirs in zip(ours[(name, light, patch)], values, strict=True):
                    difference = abs(mine - theirs) / scale
                    checked += 1
                    if difference > worst[1]:
                        worst = (f"{name} {light} {patch}", difference)
                    if difference > TOLERANCE:
                        print(f"{name} {light} {patch}: {mine:.9g} here, {theirs:.9g} by colour-science")
                        return 1
    print(f"{checked} integrals agree; the largest difference is {worst[1]:.1e} of the largest channel ({worst[0]})")
    return 0


if __name__ == "__main__":
    sys.exit(main())
