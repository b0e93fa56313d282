#!/usr/bin/env python3
"""Writes the spectra of this folder.

Measured and standardised spectra come from two packages with a clear licence, in the sampling in which they have them;
the fluorophores, filters and the black light are formulae of our own, stated in formulae.py. To run it again:

    python3 -m venv venv
    venv/bin/pip install colour-science==0.4.7 raysect==0.9.1
    venv/bin/python spectra/export.py [FOLDER]

FOLDER is this script's own unless given. The same packages give the same bytes: nothing depends on time, machine or
locale. A spectrum that is no longer
exported has to be removed by hand; `git status` shows what changed.
"""

import json
import re
import sys
import warnings
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

import formulae

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # optional dependencies (plots) that are not needed here
    import colour
    from colour.quality.cfi2017 import load_TCS_CIE2017
    from colour.quality.datasets.tcs import SDS_TCS
    from colour.quality.datasets.vs import SDS_VS

COLOUR = f"colour-science {version('colour-science')}"
RAYSECT = f"raysect {version('raysect')}"
BSD = "BSD-3-Clause (colour-science)"
OWN = "MIT (formula of our own)"

CIE15 = "CIE 015:2018 Colorimetry, 4th edition"
CIE15_2004 = "CIE 15:2004 Colorimetry, 3rd edition, tables"
CVRL = "Colour & Vision Research Laboratory (cvrl.org)"
STOCKMAN = "A. Stockman, L. T. Sharpe, Vision Research 40, 1711 (2000)"
CQS = "Y. Ohno, W. Davis, NIST CQS simulation 7.4 (2008)"
OHTA = "N. Ohta, The basis of color reproduction engineering (1997), same as ISO 17321-1:2012"

PATCHES = (
    "dark-skin light-skin blue-sky foliage blue-flower bluish-green orange purplish-blue moderate-red purple "
    "yellow-green orange-yellow blue green red yellow magenta cyan white neutral-8 neutral-6.5 neutral-5 neutral-3.5 black"
).split()

# Symbol: the file's name in raysect.
METALS = {
    "Ag": "silver", "Al": "aluminium", "Au": "gold", "Be": "beryllium", "Co": "cobolt", "Cu": "copper", "Fe": "iron",
    "Hg": "mercury", "Li": "lithium", "Mg": "magnesium", "Mn": "manganese", "Na": "sodium", "Ni": "nickel",
    "Pd": "palladium", "Pt": "platinum", "Si": "silicon", "Ti": "titanium", "W": "tungsten",
}


def number(value):
    """Twelve significant digits, none that are not needed: where a package scaled its numbers, this gives back the decimals
    that were published (0.1511 for 0.15109999999999998)."""
    text = repr(float(f"{float(value):.12g}"))
    return text[:-2] if text.endswith(".0") else text


def slug(name):
    """'F32T8/TL830 (Triphosphor)' as a file's or column's name: f32t8-tl830-triphosphor."""
    return re.sub(r"[^a-z0-9.]+", "-", name.lower()).strip("-.")


def sampling(nm):
    """'380-780 nm, 5 nm, 81 samples': what a listing shows without reading the rows."""
    steps = {round(b - a, 9) for a, b in zip(nm, nm[1:])}
    step = f"{number(steps.pop())} nm" if len(steps) == 1 else "uneven"
    return f"{number(nm[0])}-{number(nm[-1])} nm, {step}, {len(nm)} samples"


class Writer:
    def __init__(self, folder):
        self.folder = Path(folder)
        self.names = set()

    def write(self, name, title, quantity, channels, nm, columns, source, licence, relative=False, note=None):
        """One file: `columns[c][row]` belongs to channels[c]. Refuses what the reader would refuse."""
        assert name not in self.names, f"{name} written twice"
        assert all(b > a for a, b in zip(nm, nm[1:])), f"{name}: wavelengths must ascend"
        assert len(channels) == len(columns) == len(set(channels)), f"{name}: one column a channel"
        assert all(len(column) == len(nm) for column in columns), f"{name}: columns differ in length"
        self.names.add(name)
        head = {
            "title": title, "quantity": quantity, "unit": "1", "relative": "yes" if relative else "no",
            "range": sampling(nm), "source": source, "licence": licence,
        }
        if note:
            head["note"] = note
        lines = [f"# {key}: {value}" for key, value in head.items()]
        lines.append(",".join(["wavelength_nm", *channels]))
        for row, wavelength in enumerate(nm):
            lines.append(",".join([number(wavelength), *(number(column[row]) for column in columns)]))
        path = self.folder / f"{name}.csv"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")

    def distribution(self, name, sd, title, quantity, channel, source, licence=BSD, relative=False, note=None):
        self.write(name, title, quantity, [channel], sd.wavelengths, [sd.values], f"{source}; {COLOUR}", licence,
                   relative, note)

    def distributions(self, name, msds, title, quantity, channels, source, licence=BSD, relative=False, note=None):
        columns = [msds.values[:, c] for c in range(len(channels))]
        self.write(name, title, quantity, channels, msds.wavelengths, columns, f"{source}; {COLOUR}", licence, relative,
                   note)

    def chart(self, name, samples, title, source, channels=None, licence=BSD):
        """Samples of a chart (a mapping of single distributions with the same wavelengths) as one file."""
        values = list(samples.values())
        assert all((sd.wavelengths == values[0].wavelengths).all() for sd in values), name
        self.write(name, title, "reflectance", channels or [slug(key) for key in samples], values[0].wavelengths,
                   [sd.values for sd in values], f"{source}; {COLOUR}", licence)


def observers(out):
    xyz = ["X", "Y", "Z"]
    for name, key, source in (
        ("cie1931-2", "CIE 1931 2 Degree Standard Observer", f"{CIE15}; {CVRL}"),
        ("cie1964-10", "CIE 1964 10 Degree Standard Observer", f"{CIE15}; {CVRL}"),
        ("cie2015-2", "CIE 2015 2 Degree Standard Observer", f"CIE 170-2:2015; {CVRL}"),
        ("cie2015-10", "CIE 2015 10 Degree Standard Observer", f"CIE 170-2:2015; {CVRL}"),
    ):
        out.distributions(f"observers/{name}", colour.MSDS_CMFS[key], f"{key}: colour matching functions", "sensitivity",
                          xyz, source)
    for degrees in (2, 10):
        key = f"Stockman & Sharpe {degrees} Degree Cone Fundamentals"
        out.distributions(f"observers/stockman-sharpe-{degrees}", colour.MSDS_CMFS[key], key, "sensitivity",
                          ["L", "M", "S"], f"{STOCKMAN}, CIE 170-1:2006; {CVRL}", relative=True,
                          note="linear energy units, each cone's peak 1")
    for name, key in (
        ("cie1924-photopic", "CIE 1924 Photopic Standard Observer"),
        ("cie1951-scotopic", "CIE 1951 Scotopic Standard Observer"),
        ("cie2008-photopic-2", "CIE 2008 2 Degree Physiologically Relevant LEF"),
        ("cie2008-photopic-10", "CIE 2008 10 Degree Physiologically Relevant LEF"),
    ):
        out.distribution(f"observers/{name}", colour.SDS_LEFS[key], f"{key}: luminous efficiency", "sensitivity", "V", CVRL)


# Cone fundamentals to the tristimulus values of CIE 170-2:2015, 2 degrees.
LMS_TO_XYZ = ((1.94735469, -1.41445123, 0.36476327), (0.68990272, 0.34832189, 0), (0, 0, 1.93485343))


def deficient_observers(out):
    """Eyes without a cone, or with one shifted, as the X Y Z that a normal eye would need to see what they see.

    Dichromats (after F. Vienot, H. Brettel, J. D. Mollon, Color Research & Application 24, 243 (1999)): the missing cone's
    signal is the combination of the other two that is right for equal-energy white and for an anchor of the spectrum, 475 nm
    (no L, no M) or 485 nm (no S): one plane, where Brettel et al. 1997 bend it at the white.
    Anomalous trichromats (G. M. Machado, M. M. Oliveira, L. A. F. Fernandes, IEEE TVCG 15, 1291 (2009)): the shifted pigment's
    cone is a mixture of L and M in proportion to the shift, 20 nm being the whole distance.
    """
    cones = colour.MSDS_CMFS["Stockman & Sharpe 2 Degree Cone Fundamentals"]
    nm, lms = cones.wavelengths, cones.values.T
    rows = nm.astype(int).tolist()

    def write(name, title, model, changed):
        xyz = [[sum(m * c for m, c in zip(row, column)) for column in zip(*changed)] for row in LMS_TO_XYZ]
        out.write(f"observers/{name}", f"{title}: what a normal eye sees of the same", "sensitivity", ["X", "Y", "Z"], nm, xyz,
                  f"{model}; {STOCKMAN}, CIE 170-2:2015; {CVRL}; {COLOUR}", BSD, relative=True)

    for name, missing, others, anchor in (("protanope", 0, (1, 2), 475), ("deuteranope", 1, (0, 2), 475),
                                          ("tritanope", 2, (0, 1), 485)):
        at = rows.index(anchor)
        (a, b), (c, d) = [[float(lms[k].sum()), float(lms[k][at])] for k in others]
        white, spectral = float(lms[missing].sum()), float(lms[missing][at])
        determinant = a * d - b * c
        first, second = (white * d - spectral * c) / determinant, (a * spectral - b * white) / determinant
        changed = [curve.tolist() for curve in lms]
        changed[missing] = [first * p + second * q for p, q in zip(changed[others[0]], changed[others[1]])]
        write(name, name.capitalize(), "one plane after Vienot, Brettel, Mollon (1999)", changed)

    shift = 10
    area = [float(curve.sum()) for curve in lms]
    for name, anomalous, normal, ratio in (("protanomalous-10", 0, 1, 0.96 * area[0] / area[1]),
                                           ("deuteranomalous-10", 1, 0, area[1] / area[0] / 0.96)):
        alpha = (20 - shift) / 20
        changed = [curve.tolist() for curve in lms]
        changed[anomalous] = [alpha * own + (1 - alpha) * ratio * other for own, other in zip(lms[anomalous], lms[normal])]
        write(name, f"{name.split('-')[0].capitalize()} eye, pigment shifted by {shift} nm",
              "Machado, Oliveira, Fernandes (2009)", changed)


def illuminants(out):
    for key, sd in colour.SDS_ILLUMINANTS.items():
        if key == "ISO 7589 Sensitometric Printer":
            continue  # stops at its maximum (560 nm): a light for blue-sensitive layers only, not a lamp to light a scene
        if key.startswith("ISO 7589"):
            name, source, title = slug(key).replace("iso-7589", "iso7589"), "ISO 7589:2002", f"{key} illuminant"
        else:
            name, title = key, f"CIE illuminant {key}"
            source = CIE15 if key[0] in "LI" or key == "D60" else f"{CIE15}; {CIE15_2004}"
        out.distribution(f"illuminants/{name}", sd, title, "power", "power", source, relative=True)


def lamps(out):
    groups = colour.colorimetry.datasets.light_sources.sds
    spelling = {"SA": "Source A", "SC": "Source C", "Neodimium Incandescent": "Neodymium Incandescent"}
    for lights, source in (
        (groups.SDS_LIGHT_SOURCES_RIT, "M. R. Pointer, PointerData.xls, RIT Munsell Color Science Laboratory (1980)"),
        (groups.SDS_LIGHT_SOURCES_NIST_TRADITIONAL, f"{CQS}, traditional lamps"),
        (groups.SDS_LIGHT_SOURCES_NIST_LED, f"{CQS}, LED lamps, some of them models"),
        (groups.SDS_LIGHT_SOURCES_NIST_PHILIPS, f"{CQS}, Philips lamps"),
        (groups.SDS_LIGHT_SOURCES_COMMON, "T. Borer, BBC, private communication to the authors of the package (2017)"),
    ):
        for key, sd in lights.items():
            title = spelling.get(key, key)
            out.distribution(f"lamps/{slug(title)}", sd, f"Light source {title}", "power", "power", source, relative=True)


def cameras_and_displays(out):
    rgb = ["R", "G", "B"]
    npl = "M. M. Darrodi et al., J. Opt. Soc. Am. A 32, 381 (2015), measured at NPL"
    for name, key, title in (("nikon-5100", "Nikon 5100 (NPL)", "Nikon D5100"),
                             ("sigma-sd-merrill", "Sigma SDMerill (NPL)", "Sigma SD1 Merrill")):
        out.distributions(f"cameras/{name}", colour.MSDS_CAMERA_SENSITIVITIES[key], f"{title}, spectral sensitivities",
                          "sensitivity", rgb, npl, relative=True, note="maximum of each channel 1")
    machado = "G. M. Machado, A model for simulation of color vision deficiency (2010)"
    for name, key, title in (("crt-brainard-1997", "Typical CRT Brainard 1997", "Typical CRT (Brainard 1997)"),
                             ("lcd-apple-studio", "Apple Studio Display", "Apple Studio Display, LCD")):
        out.distributions(f"displays/{name}", colour.MSDS_DISPLAY_PRIMARIES[key], f"{title}, primaries", "radiance", rgb,
                          machado, relative=True)


def charts(out):
    checkers = colour.SDS_COLOURCHECKERS
    out.chart("charts/colorchecker", checkers["BabelColor Average"], "ColorChecker Classic, average of 30 charts",
              "D. Pascale, The ColorChecker (since 1976!), BabelColor (2012)", PATCHES,
              f"{BSD}; BabelColor ColorChecker data: Copyright (C) 2004-2012 Danny Pascale (www.babelcolor.com), "
              "used by permission")
    out.chart("charts/colorchecker-ohta1997", checkers["ColorChecker N Ohta"], "ColorChecker Classic, one chart", OHTA,
              PATCHES)
    out.chart("charts/pmc", checkers["PMC"], "Preferred memory colour chart, 30 patches",
              "M. R. Luo, Color Research & Application, doi:10.1002/col.22940 (2024)")
    out.chart("charts/tcs", SDS_TCS["CIE 1995"], "CIE test colour samples 1-14 of the colour rendering index",
              f"CIE 13.3-1995; {CQS}")
    for edition in ("7.4", "9.0"):
        out.chart(f"charts/cqs-{edition}", SDS_VS[f"NIST CQS {edition}"],
                  f"NIST colour quality scale {edition}, saturated test colours", f"NIST CQS simulation {edition}")
    # The package also has these at 1 nm, interpolated from the 5 nm of the publication.
    ces = load_TCS_CIE2017(colour.SpectralShape(380, 780, 5))
    out.distributions("charts/ces99", ces, "99 colour evaluation samples of the colour fidelity index", "reflectance",
                      [f"ces{i + 1:02d}" for i in range(99)], "CIE 224:2017, ANSI/IES TM-30-18")


def metals(out):
    data = Path(find_spec("raysect").origin).parent / "optical/library/metal/data"
    for symbol, file in METALS.items():
        metal = json.loads((data / f"{file}.json").read_text(encoding="utf-8"))
        reference = " ".join(re.sub(r"<[^>]*>", "", metal["reference"]).split())
        title = {"cobolt": "cobalt"}.get(file, file).capitalize()
        out.write(f"metals/{symbol}", f"{title}, complex refractive index", "index", ["n", "k"], metal["wavelength"],
                  [metal["index"], metal["extinction"]], f"{reference}; refractiveindex.info; {RAYSECT}",
                  "CC0-1.0 (refractiveindex.info); BSD-3-Clause (raysect)")


def filters(out):
    for name, key, sd, title in (
        ("iso7589-diffuser", "ISO 7589 Diffuser", colour.SDS_FILTERS, "ISO 7589 diffuser, relative transmittance"),
        ("iso-standard-lens", "ISO Standard Lens", colour.SDS_LENSES, "ISO standard lens, relative transmittance"),
    ):
        out.distribution(f"filters/{name}", sd[key], title, "transmittance", "transmittance", "ISO 7589:2002", relative=True)


def formula_spectra(out):
    for name, spectrum in formulae.spectra().items():
        out.write(name, licence=OWN, **spectrum)


def main():
    out = Writer(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parent)
    for export in (observers, deficient_observers, illuminants, lamps, cameras_and_displays, charts, metals, filters, formula_spectra):
        export(out)
    print(f"{len(out.names)} files in {out.folder}", file=sys.stderr)


if __name__ == "__main__":
    main()
