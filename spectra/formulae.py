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


# Quantum efficiency of a front-illuminated CCD: (height, rising edge, falling edge); the polysilicon gates take the blue, silicon's
# transparency the infrared. Relative: near its maximum 1.
CCD = (1.34, (460, 49), (702, 92))

# A reversal film of the E-6 kind. Layers: linear sensitivity per energy, 10^(slope (nm - 550)) between a rising and a falling
# edge, peak 1: (slope per nm, rising, falling). Dyes: spectral density at peak 1, a log-normal band (height, peak, width, skew) and
# a Gaussian of its secondary absorption (height, peak, width). Base: support, fog and stain.
FILM_LAYERS = {
    "R": (0.019, (579, 2.5), (654, 4.1)),
    "G": (-0.008, (540, 12.8), (585, 2.9)),
    "B": (-0.004, (408, 7.3), (475, 5.0)),
}
FILM_DYES = {
    "C": ((1.0, 660, 137, 0.9), (0.29, 320, 190)),
    "M": ((0.975, 546, 89, 1.1), (0.175, 447, 124)),
    "Y": ((1.0, 447, 97, 1.05), (0.0, 447, 97)),
}
FILM_BASE = (0.05, 0.10, (395, 8))  # density everywhere; what is added at short wavelengths, and the edge where it ends


def gaussian(nm, centre, width):
    """Peak 1, full width at half maximum `width`."""
    return math.exp(-4 * math.log(2) * ((nm - centre) / width) ** 2)


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


def transmittance(name, nm):
    _, peak, rising, falling = FILTERS[name]
    return peak * edge(nm, *rising) * (1 - edge(nm, *falling) if falling else 1)


def ccd(nm):
    height, rising, falling = CCD
    return height * edge(nm, *rising) * (1 - edge(nm, *falling))


def sensor():
    nm = list(range(300, 1101))
    return {
        "title": "Front-illuminated CCD, quantum efficiency", "quantity": "sensitivity", "channels": ["qe"], "nm": nm,
        "columns": [[rounded(ccd(x)) for x in nm]], "relative": True, "source": "logistic edges, formulae.py",
        "note": "electrons per photon, relative; as a factor of a detector write qe:sensors/ccd",
    }


def separation_camera():
    """The camera of the paper's figure 3: a monochrome CCD behind red, green and blue separation filters in turn. Per energy, so
    the quantum efficiency counts times the wavelength."""
    nm = list(range(360, 801))
    channels = {"R": "red", "G": "green", "B": "blue"}
    columns = [[ccd(x) * x / 550 * transmittance("ir-cut", x) * transmittance(f, x) for x in nm] for f in channels.values()]
    peak = max(max(column) for column in columns)
    return {
        "title": "Camera of the DCS 200's kind: CCD behind separation filters", "quantity": "sensitivity",
        "channels": list(channels), "nm": nm, "columns": [[rounded(v / peak) for v in column] for column in columns],
        "relative": True, "source": "product of the formulae of sensors/ccd, filters/ir-cut and filters/red, green, blue",
        "note": "energy units, largest channel 1",
    }


def film_layers():
    nm = list(range(360, 731))
    columns = []
    for slope, rising, falling in FILM_LAYERS.values():
        values = [10 ** (slope * (x - 550)) * edge(x, *rising) * (1 - edge(x, *falling)) for x in nm]
        columns.append([rounded(v / max(values)) for v in values])
    return {
        "title": "Generic reversal film, sensitivities of its layers", "quantity": "sensitivity",
        "channels": list(FILM_LAYERS), "nm": nm, "columns": columns, "relative": True,
        "source": "logistic edges, formulae.py", "note": "per energy, each layer's peak 1",
    }


def film_dyes():
    nm = list(range(360, 801))
    columns = []
    for (height, peak, width, skew), second in FILM_DYES.values():
        values = [height * log_normal(x, peak, width, skew) + second[0] * gaussian(x, *second[1:]) for x in nm]
        columns.append([rounded(v) for v in values])
    density, more, fall = FILM_BASE
    columns.append([rounded(density + more * (1 - edge(x, *fall))) for x in nm])
    return {
        "title": "Generic reversal film, densities of its dyes and base", "quantity": "density",
        "channels": [*FILM_DYES, "base"], "nm": nm, "columns": columns, "source": "log-normal bands, formulae.py",
        "note": "diffuse spectral density of one unit of each dye; base: support and fog",
    }


def black_light():
    centre, width = PHOSPHOR
    area = width * math.sqrt(math.pi / (4 * math.log(2)))
    corners = {round(line + d, 2) for line in MERCURY for d in (-SLIT, 0, SLIT)}
    nm = sorted(set(range(320, 601)) | corners)
    values = [
        gaussian(x, centre, width)
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
    result["sensors/ccd"] = sensor()
    result["cameras/dcs200-like"] = separation_camera()
    result["films/generic-reversal-layers"] = film_layers()
    result["films/generic-reversal-dyes"] = film_dyes()
    return result
