#!/usr/bin/env python3
"""Reads cubes with OpenImageIO: channels, their order and type, header and values."""
import expected

oiio, np = expected.need("OpenImageIO", "numpy")


def check_file(cube):
    image = oiio.ImageInput.open(cube)
    assert image, oiio.geterror()
    spec = image.spec()
    pixels = image.read_image("float")
    bands = [(index, name) for index, name in enumerate(spec.channelnames) if expected.wavelength_of(name) is not None]
    wavelengths = [expected.wavelength_of(name) for _, name in bands]
    # colour-science and others take the file's order for the order of wavelengths.
    assert wavelengths == sorted(wavelengths), f"{cube}: bands are not in ascending order"
    assert spec.channelnames[:3] == ("R", "G", "B"), f"{cube}: no RGB preview"
    assert len(set(spec.channelformats)) <= 1, f"{cube}: bands and preview differ in type"
    emissive = expected.expectation(cube)["kind"] in ("radiance", "irradiance")
    assert spec.get_string_attribute("spectralLayoutVersion") == "1.0"
    assert spec.get_string_attribute("emissiveUnits") == ("W.m^-2.sr^-1" if emissive else "")
    assert isinstance(spec.getattribute("EV"), float)
    assert all(len(name) <= 31 for name in spec.channelnames)
    expected.check(cube, spec.width, spec.height, wavelengths, lambda x, y, band: pixels[y, x, bands[band][0]])


expected.main(check_file)
