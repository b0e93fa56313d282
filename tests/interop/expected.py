"""What a cube file must hold, as the test program wrote it beside the file, and how to say that it does not."""
import json
import pathlib
import re
import sys

SKIPPED = 77  # exit code: a package is missing


def need(*modules):
    """Import modules by name, or end the script as skipped."""
    import importlib
    try:
        return [importlib.import_module(name) for name in modules]
    except ImportError as error:
        print(f"skipped: {error}")
        sys.exit(SKIPPED)


def expectation(cube):
    return json.loads(pathlib.Path(cube).with_suffix(".json").read_text())


def wavelength_of(channel):
    """nm of a name such as S0.0380,000000nm, or None."""
    found = re.fullmatch(r"(?:S0|T)\.(\d+,\d+)nm", channel)
    return float(found[1].replace(",", ".")) if found else None


def check(cube, width, height, wavelengths, value_at, tolerance=1e-5):
    """value_at(x, y, band) must be exactly what was written; wavelengths may have passed through text or float32."""
    want = expectation(cube)
    assert (width, height) == (want["width"], want["height"]), f"{cube}: {width}x{height} pixels"
    assert len(wavelengths) == len(want["wavelengths_nm"]), f"{cube}: {len(wavelengths)} bands"
    for got, nm in zip(wavelengths, want["wavelengths_nm"]):
        assert abs(got - nm) <= tolerance * nm, f"{cube}: {got} nm where {nm} was written"
    for sample in want["samples"]:
        for band, value in enumerate(sample["values"]):
            got = float(value_at(sample["x"], sample["y"], band))
            assert got == value, f"{cube}: pixel {sample['x']},{sample['y']} band {band} is {got}, not {value}"
    print(f"{cube}: {width}x{height}, {len(wavelengths)} bands as written")


def main(check_file):
    if len(sys.argv) < 2:
        sys.exit(f"usage: {sys.argv[0]} CUBE...")
    for cube in sys.argv[1:]:
        check_file(cube)
