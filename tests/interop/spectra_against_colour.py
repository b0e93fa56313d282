#!/usr/bin/env python3
"""The spectra that ship against the tables and the integration of colour-science.

    pip install colour-science numpy        # any recent version; the files were exported from 0.4.7
    python3 tests/interop/spectra_against_colour.py [SPECTRA]

Checks, each to 1e-6:
  tables   every observer, illuminant, camera, display and chart file against the package's table, value by value;
  XYZ      of 24 ColorChecker patches and white under each CIE illuminant for two observers: summed here from the files, every
           1 nm and linear between samples, against colour.sd_to_XYZ_integration() on the package's own tables.
Exit code 0: all agree; 1: a difference, with its name; 77: colour-science is not installed, nothing was checked.
"""

import sys
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
OBSERVERS = {
    "cie1931-2": "CIE 1931 2 Degree Standard Observer",
    "cie1964-10": "CIE 1964 10 Degree Standard Observer",
    "cie2015-2": "CIE 2015 2 Degree Standard Observer",
    "cie2015-10": "CIE 2015 10 Degree Standard Observer",
    "stockman-sharpe-2": "Stockman & Sharpe 2 Degree Cone Fundamentals",
    "stockman-sharpe-10": "Stockman & Sharpe 10 Degree Cone Fundamentals",
}
CAMERAS = {"nikon-5100": "Nikon 5100 (NPL)", "sigma-sd-merrill": "Sigma SDMerill (NPL)"}
DISPLAYS = {"crt-brainard-1997": "Typical CRT Brainard 1997", "lcd-apple-studio": "Apple Studio Display"}
CHARTS = {"colorchecker": "BabelColor Average", "colorchecker-ohta1997": "ColorChecker N Ohta"}


def read(file):
    """Wavelengths and columns of a library file."""
    rows = [line for line in file.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    table = np.array([[float(cell) for cell in row.split(",")] for row in rows[1:]])
    return table[:, 0], table[:, 1:]


def table_pairs(folder):
    """(name, wavelengths and columns of the file, those of the package)."""
    for group, names, package in (
        ("observers", OBSERVERS, colour.MSDS_CMFS),
        ("cameras", CAMERAS, colour.MSDS_CAMERA_SENSITIVITIES),
        ("displays", DISPLAYS, colour.MSDS_DISPLAY_PRIMARIES),
    ):
        for name, key in names.items():
            theirs = package[key]
            yield f"{group}/{name}", read(folder / group / f"{name}.csv"), (theirs.wavelengths, theirs.values)
    for key in cie_illuminants():
        theirs = colour.SDS_ILLUMINANTS[key]
        yield f"illuminants/{key}", read(folder / f"illuminants/{key}.csv"), (theirs.wavelengths, theirs.values[:, None])
    for name, key in CHARTS.items():
        patches = list(colour.SDS_COLOURCHECKERS[key].values())
        columns = np.stack([patch.values for patch in patches], axis=1)
        yield f"charts/{name}", read(folder / f"charts/{name}.csv"), (patches[0].wavelengths, columns)


def cie_illuminants():
    return [key for key in colour.SDS_ILLUMINANTS if not key.startswith("ISO")]


def compare_tables(folder):
    checked, wrong = 0, []
    for name, (nm, ours), (their_nm, theirs) in table_pairs(folder):
        checked += 1
        if ours.shape != theirs.shape or not np.array_equal(nm, their_nm):
            wrong.append(f"{name}: {ours.shape} values instead of {theirs.shape}, or other wavelengths")
        elif (difference := np.abs(ours - theirs).max() / np.abs(theirs).max()) > TOLERANCE:
            wrong.append(f"{name}: differs by {difference:.2g} of its maximum")
    return checked, wrong


def summed(grid, light, reflectance, functions):
    """XYZ, Y of a perfect white 100: sums over 1 nm of values linear between samples."""
    at = np.interp(grid, *light, left=0, right=0)
    weights = at[:, None] * np.stack([np.interp(grid, functions[0], column) for column in functions[1].T], axis=1)
    return 100 * (np.interp(grid, *reflectance) @ weights) / weights[:, 1].sum()


def colours_of_package(grid, light, reflectance, cmfs):
    """The same by colour-science from its own tables, brought to 1 nm by its own linear interpolator."""
    shape = colour.SpectralShape(grid[0], grid[-1], 1)
    linear = {"interpolator": colour.LinearInterpolator}
    held = {"extrapolator_kwargs": {"method": "Constant"}}
    dark = {"extrapolator_kwargs": {"method": "Constant", "left": 0, "right": 0}}
    light = light.copy().interpolate(interval(light), **linear).extrapolate(shape, **dark).trim(shape)
    reflectance = reflectance.copy().interpolate(interval(reflectance), **linear).extrapolate(shape, **held).trim(shape)
    return colour.colorimetry.sd_to_XYZ_integration(reflectance, cmfs, light, shape=shape)


def interval(distribution):
    return colour.SpectralShape(distribution.shape.start, distribution.shape.end, 1)


def compare_colours(folder):
    checked, wrong = 0, []
    nm, patches = read(folder / "charts/colorchecker.csv")
    samples = [(column, patch) for column, patch in zip(patches.T, colour.SDS_COLOURCHECKERS["BabelColor Average"].values())]
    white = colour.SpectralDistribution(np.ones(len(nm)), nm)
    samples.append((np.ones(len(nm)), white))
    for observer in ("cie1931-2", "cie1964-10"):
        functions = read(folder / f"observers/{observer}.csv")
        cmfs = colour.MSDS_CMFS[OBSERVERS[observer]]
        for key in cie_illuminants():
            light_nm, light = read(folder / f"illuminants/{key}.csv")
            for i, (column, patch) in enumerate(samples):
                ours = summed(functions[0], (light_nm, light[:, 0]), (nm, column), functions)
                theirs = colours_of_package(functions[0], colour.SDS_ILLUMINANTS[key], patch, cmfs)
                checked += 1
                if (difference := np.abs(ours - theirs).max()) > TOLERANCE * 100:
                    wrong.append(f"patch {i + 1} under {key} for {observer}: XYZ {ours} here, {theirs} there")
    return checked, wrong


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parents[2] / "spectra"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        tables, wrong_tables = compare_tables(folder)
        colours, wrong_colours = compare_colours(folder)
    wrong = wrong_tables + wrong_colours
    for line in wrong:
        print(line)
    print(f"colour-science {colour.__version__}: {tables} tables and {colours} colours, {len(wrong)} differ")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
