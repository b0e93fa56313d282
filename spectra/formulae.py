"""Spectra of our own: few parameters, stated here, for materials and lamps of which no free measurement ships.

They are shapes that are typical of their kind, not measurements of a product. Peaks and widths follow the literature
named beside them, rounded; nothing was traced from a published curve.
"""

import math


def log_normal(nm, peak, width, skew):
    """Asymmetric band, 1 at `peak`, full width at half maximum `width` (both nm).

    D. B. Siano, D. E. Metzler, J. Chem. Phys. 51, 1856 (1969), here over wavelength: exp(-ln 2 (ln u / ln s)^2) with
    u = 1 + (nm - peak) (s^2 - 1) / (s width). `skew` s is the half-width towards long wavelengths divided by the one
    towards short ones: above 1 for emission (vibrational tail to the red), below 1 for absorption (shoulder to the blue).
    """
    u = 1 + (nm - peak) * (skew * skew - 1) / (skew * width)
    return math.exp(-math.log(2) * (math.log(u) / math.log(skew)) ** 2) if u > 0 else 0.0


def edge(nm, centre, width):
    """Logistic step from 0 to 1, 1/2 at `centre`; 10 % to 90 % takes 4.39 `width`."""
    return 1 / (1 + math.exp(-(nm - centre) / width))


def triangle(nm, centre, width):
    """What a slit of bandwidth `width` makes of a line: peak 1, area `width`."""
    return max(0.0, 1 - abs(nm - centre) / width)


def rounded(value):
    """Six significant digits, and nothing below 1e-6: the formulae claim no more, and mathematical libraries differ beyond."""
    return float(f"{value:.6g}") if abs(value) >= 1e-6 else 0.0


# Excitation and emission bands: (peak nm, width nm, skew, height). Sources of peaks and widths:
#  optical brightener  stilbene-triazine brighteners of paper and textiles absorb at 340-375 nm and emit at 430-440 nm
#                      (H. Zollinger, Color Chemistry, 3rd ed. 2003, chapter on fluorescent brighteners)
#  quinine             quinine sulphate in acid, 347 and 450 nm, the old fluorescence standard
#                      (J. R. Lakowicz, Principles of Fluorescence Spectroscopy, 3rd ed. 2006)
#  yellow              coumarin 6, 458 and 505 nm; green: fluorescein, 491 and 515 nm; orange: rhodamine 6G, 530 and
#                      555 nm; red: rhodamine B, 550 and 580 nm, in ethanol or water (H. Du et al., PhotochemCAD,
#                      Photochem. Photobiol. 68, 141 (1998); U. Brackmann, Lambdachrome Laser Dyes, 3rd ed. 2000).
#                      In pigments and inks both bands lie some 5 nm farther to the red and are broader: used so here.
FLUOROPHORES = {
    "optical-brightener": ("Optical brightener of the stilbene kind", [(362, 68, 0.8, 1)], [(437, 62, 1.7, 1)]),
    "quinine": ("Quinine sulphate in acid", [(347, 42, 0.8, 1), (318, 30, 0.9, 0.45)], [(452, 88, 1.3, 1)]),
    "yellow": ("Fluorescent yellow of the coumarin kind", [(460, 72, 0.75, 1)], [(511, 56, 1.8, 1)]),
    "green": ("Fluorescent green of the fluorescein kind", [(494, 42, 0.6, 1), (322, 40, 0.9, 0.12)], [(519, 40, 1.9, 1)]),
    "orange": ("Fluorescent orange of the rhodamine 6G kind", [(534, 46, 0.65, 1), (349, 36, 0.9, 0.09)], [(562, 44, 1.8, 1)]),
    "red": ("Fluorescent red of the rhodamine B kind", [(555, 48, 0.65, 1), (356, 40, 0.9, 0.1)], [(588, 46, 1.8, 1)]),
}

# Separation filters as the product of edges, (centre nm, width nm), rising and falling, times the peak transmittance; the
# red, green and blue bands part near 490 and 585 nm like the absorption filters of three-colour photography.
FILTERS = {
    "red": ("Red separation filter", 0.90, (597, 5), None),
    "green": ("Green separation filter", 0.68, (497, 8), (578, 8)),
    "blue": ("Blue separation filter", 0.55, (385, 10), (490, 8)),
    "uv-cut": ("Ultraviolet cut filter", 0.92, (408, 3), None),
    "ir-cut": ("Infrared cut filter", 0.92, (350, 5), (682, 9)),
}

# Black light: a low-pressure mercury tube with the europium-doped strontium borate phosphor (band at 368 nm, some 17 nm wide) in
# dark nickel-oxide glass, which lets only a little of the visible mercury lines pass. Lines: wavelengths in air (NIST Atomic
# Spectra Database), and their area as a fraction of the phosphor band's. Drawn with a slit of 1 nm.
PHOSPHOR = (368, 17)
MERCURY = {365.02: 0.05, 404.66: 0.012, 435.83: 0.006, 546.07: 0.0004}
SLIT = 1.0


def fluorophore(title, excitation, emission):
    nm = list(range(220, 851))
    columns = []
    for bands in (excitation, emission):
        values = [sum(height * log_normal(x, peak, width, skew) for peak, width, skew, height in bands) for x in nm]
        peak = max(values)
        columns.append([rounded(value / peak) for value in values])
    return {
        "title": title, "quantity": "reradiation", "channels": ["excitation", "emission"], "nm": nm, "columns": columns,
        "relative": True, "source": "log-normal bands, formulae.py",
        "note": "peaks 1; excitation: absorbed fraction, emission: energy per nm",
    }


def separation_filter(title, peak, rising, falling):
    nm = list(range(300, 1101))
    values = [peak * edge(x, *rising) * (1 - edge(x, *falling) if falling else 1) for x in nm]
    return {
        "title": title, "quantity": "transmittance", "channels": ["transmittance"], "nm": nm,
        "columns": [[rounded(value) for value in values]], "source": "logistic edges, formulae.py",
    }


def black_light():
    centre, width = PHOSPHOR
    area = width * math.sqrt(math.pi / (4 * math.log(2)))
    corners = {round(line + d, 2) for line in MERCURY for d in (-SLIT, 0, SLIT)}
    nm = sorted(set(range(320, 601)) | corners)
    values = [
        math.exp(-4 * math.log(2) * ((x - centre) / width) ** 2)
        + sum(share * area / SLIT * triangle(x, line, SLIT) for line, share in MERCURY.items())
        for x in nm
    ]
    return {
        "title": "Black light, mercury tube with a 368 nm phosphor", "quantity": "power", "channels": ["power"], "nm": nm,
        "columns": [[rounded(value) for value in values]], "relative": True,
        "source": "Gaussian phosphor band and mercury lines, formulae.py", "note": "lines as a slit of 1 nm sees them",
    }


def spectra():
    """Name: what Writer.write() takes, but the licence."""
    result = {f"fluorophores/{name}": fluorophore(*parameters) for name, parameters in FLUOROPHORES.items()}
    result |= {f"filters/{name}": separation_filter(*parameters) for name, parameters in FILTERS.items()}
    result["lamps/uv-365"] = black_light()
    return result
