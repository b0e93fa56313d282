#!/usr/bin/env python3
"""Reads cubes with colour-science's own reader of the layout."""
import expected

oiio, colour = expected.need("OpenImageIO", "colour")


def check_file(cube):
    components = colour.read_spectral_image_Fichet2021(cube)
    want = "S0" if expected.expectation(cube)["kind"] in ("radiance", "irradiance") else "T"
    assert list(components) == [want], f"{cube}: components {list(components)}"
    wavelengths, pixels = components[want]
    expected.check(cube, pixels.shape[1], pixels.shape[0], list(wavelengths), lambda x, y, band: pixels[y, x, band])


expected.main(check_file)
