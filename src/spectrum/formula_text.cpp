#include "spectrum/formula_text.h"

#include "base/text.h"
#include "spectrum/dispersion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace spectrad {

namespace {

/// One formula as it is being read: its name, its numbers, and how it should look.
struct Reading {
    std::string_view name, example;
    std::vector<std::string_view> parts;
    SourceLocation where;

    [[noreturn]] void fail(const std::string& wrong) const {
        throw InputError(where, fmt::format("{}: {} (allowed: as in {})", name, wrong, example));
    }
    void expect(size_t least, size_t most, std::string_view what) const {
        if (parts.size() < least || parts.size() > most) fail(fmt::format("takes {}", what));
    }
    [[nodiscard]] double number(size_t i) const {
        const auto value = parseDouble(parts[i]);
        if (!value) fail(fmt::format("'{}' is not a finite number", parts[i]));
        return *value;
    }
    [[nodiscard]] double number(size_t i, std::string_view what, double least, double most,
                                std::string_view unit) const {
        const double value = number(i);
        if (!(value >= least && value <= most))
            throw InputError(
                where, fmt::format("{}: {} {}{} (allowed: {} … {}{})", name, what, shortest(value), unit,
                                   shortest(least), shortest(most), unit));
        return value;
    }
    [[nodiscard]] double wavelength(size_t i) const { return number(i, "wavelength", 1, 1e6, " nm"); }
    /// A width that doubles can still resolve beside the wavelength.
    [[nodiscard]] double width(size_t i, std::string_view what) const {
        return number(i, what, 1e-6, 1e6, " nm");
    }
};

Spectrum lampFormula(Curve curve) {
    Spectrum spectrum;
    spectrum.quantity = Quantity::power;
    spectrum.unit = "1";
    spectrum.curves = {std::move(curve)};
    return spectrum;
}

Spectrum plainFormula(Curve curve) {
    Spectrum spectrum;
    spectrum.curves = {std::move(curve)};
    return spectrum;
}

Spectrum indexFormula(const Reading& reading, std::optional<Curve> curve) {
    if (!curve) reading.fail("gives no index between 1 and 6 anywhere from 0.1 to 20 µm");
    Spectrum spectrum;
    spectrum.quantity = Quantity::index;
    spectrum.unit = "1";
    spectrum.curves = {std::move(*curve)};
    return spectrum;
}

std::vector<double> numbersOf(const Reading& reading) {
    std::vector<double> numbers;
    for (size_t i = 0; i < reading.parts.size(); ++i)
        numbers.push_back(reading.number(i));
    return numbers;
}

std::array<double, 3> hexColour(const Reading& reading) {
    const std::string_view text = reading.parts.size() == 1 ? reading.parts[0] : "";
    const bool hex =
        text.size() == 7 && text[0] == '#' && std::all_of(text.begin() + 1, text.end(), [](char c) {
            return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
        });
    if (!hex) reading.fail("takes # and six hexadecimal digits");
    const auto digit = [](char c) { return c <= '9' ? c - '0' : (c | 0x20) - 'a' + 10; };
    std::array<double, 3> rgb{};
    for (size_t i = 0; i < 3; ++i)
        rgb[i] = linearOfSrgb((16 * digit(text[1 + 2 * i]) + digit(text[2 + 2 * i])) / 255.0);
    return rgb;
}

std::array<double, 3> linearColour(const Reading& reading, double most) {
    reading.expect(3, 3, "three linear sRGB components");
    std::array<double, 3> rgb{};
    for (size_t i = 0; i < 3; ++i)
        rgb[i] = reading.number(i, "component", 0, most, "");
    return rgb;
}

/// A surface's colour is a reflectance; a lamp's is that reflectance under D65, as bright as its largest
/// component if that is above 1.
Spectrum colourSpectrum(std::array<double, 3> rgb, bool lamp, const ColourSource& colours) {
    if (!lamp) {
        Spectrum spectrum = plainFormula(colours.lift(rgb).curve());
        spectrum.quantity = Quantity::reflectance;
        spectrum.unit = "1";
        return spectrum;
    }
    const double scale = std::max(1.0, *std::max_element(rgb.begin(), rgb.end()));
    for (double& component : rgb)
        component /= scale;
    const Curve filter = colours.lift(rgb).curve(), daylight = colours.daylight().withOutside(Outside::zero);
    const auto at = [=](double nm) { return scale * filter.at(nm) * daylight.at(nm); };
    const auto breaks = [=](double from, double to, std::vector<double>& out) {
        const auto start = static_cast<std::ptrdiff_t>(out.size());
        filter.appendBreaks(from, to, out);
        const auto middle = static_cast<std::ptrdiff_t>(out.size());
        daylight.appendBreaks(from, to, out);
        std::inplace_merge(out.begin() + start, out.begin() + middle, out.end());
        out.erase(std::unique(out.begin() + start, out.end()), out.end());
    };
    return lampFormula(Curve::formula(at, breaks, daylight.range()));
}

}  // namespace

const std::vector<std::string>& formulaNames() {
    static const std::vector<std::string> names{"constant", "blackbody", "daylight",  "gaussian", "line",
                                                "srgb",     "rgb",       "sellmeier", "cauchy"};
    return names;
}

bool isFormula(std::string_view text) {
    const size_t colon = text.find(':');
    if (colon == std::string_view::npos) return false;
    const auto& names = formulaNames();
    return std::find(names.begin(), names.end(), trimmed(text.substr(0, colon))) != names.end();
}

bool isColourFormula(std::string_view text) {
    return startsWith(trimmed(text), "srgb:") || startsWith(trimmed(text), "rgb:");
}

Spectrum constantSpectrum(std::string_view text, double value) {
    Spectrum spectrum = plainFormula(Curve::constant(value));
    spectrum.text = text;
    spectrum.relative = spectrum.formula = true;
    spectrum.channels = {"value"};
    return spectrum;
}

static Spectrum readFormula(Reading reading, bool lamp, const ColourSource& colours) {
    const auto example = [&](std::string_view text) -> Reading& {
        reading.example = text;
        return reading;
    };
    if (reading.name == "constant") {
        example("constant:0.18").expect(1, 1, "one number");
        return plainFormula(Curve::constant(reading.number(0)));
    }
    if (reading.name == "blackbody") {
        example("blackbody:2856").expect(1, 1, "one temperature in kelvin");
        return lampFormula(Curve::blackbody(reading.number(0, "temperature", 1, 1e8, " K")));
    }
    if (reading.name == "daylight") {
        example("daylight:6504").expect(1, 1, "one correlated colour temperature in kelvin");
        return lampFormula(Curve::daylight(reading.number(0, "temperature", 4000, 25'000, " K")));
    }
    if (reading.name == "gaussian") {
        example("gaussian:450,20").expect(2, 2, "its centre and its full width at half maximum, in nm");
        return plainFormula(Curve::gaussian(reading.wavelength(0), reading.width(1, "width")));
    }
    if (reading.name == "line") {
        example("line:632.8 or line:632.8,0.01").expect(1, 2, "a wavelength and perhaps a width, in nm");
        if (reading.parts.size() == 1) return plainFormula(Curve::line(reading.wavelength(0)));
        return plainFormula(Curve::rectangle(reading.wavelength(0), reading.width(1, "width")));
    }
    if (reading.name == "srgb") return colourSpectrum(hexColour(example("srgb:#c04020")), lamp, colours);
    if (reading.name == "rgb")
        return colourSpectrum(linearColour(example("rgb:0.8,0.2,0.1"), lamp ? 1e6 : 1), lamp, colours);
    if (reading.name == "sellmeier") {
        example("sellmeier:1.03961212,0.00600069867,0.231792344,0.0200179144,1.01046945,103.560653");
        reading.expect(2, 6, "pairs B,C of numbers, one to three, C in µm²");
        if (reading.parts.size() % 2 != 0) reading.fail("takes pairs B,C of numbers, one to three, C in µm²");
        return indexFormula(reading, sellmeier(numbersOf(reading)));
    }
    example("cauchy:1.5046,0.0042,0").expect(1, 3, "A, B and C, for λ in µm");
    return indexFormula(reading, cauchy(numbersOf(reading)));
}

Spectrum formulaSpectrum(std::string_view text, bool lamp, const ColourSource& colours,
                         const SourceLocation& where) {
    text = trimmed(text);
    const size_t colon = text.find(':');
    const std::string_view name = trimmed(text.substr(0, colon));
    Spectrum spectrum = readFormula({name, "", split(text.substr(colon + 1), ','), where}, lamp, colours);
    spectrum.text = text;
    spectrum.relative = spectrum.formula = true;
    spectrum.channels = {spectrum.quantity == Quantity::index ? "n" : "value"};
    return spectrum;
}

}  // namespace spectrad
