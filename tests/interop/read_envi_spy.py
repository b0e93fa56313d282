#!/usr/bin/env python3
"""Reads ENVI cubes with Spectral Python."""
import pathlib

import expected

spectral, np = expected.need("spectral", "numpy")


def check_file(cube):
    image = spectral.open_image(str(pathlib.Path(cube).with_suffix(".hdr")))
    height, width, bands = image.shape
    pixels = image.load()
    assert image.bands.band_unit == "Nanometers", image.bands.band_unit
    assert len(image.bands.bandwidths) == bands
    assert image.metadata["data units"] == "W/(m^2 sr nm)"
    expected.check(cube, width, height, image.bands.centers, lambda x, y, band: pixels[y, x, band], tolerance=0)


expected.main(check_file)
