// spectrad info SPECTRUM: what it is, its range and integral, its colour, and a picture of it.
#include "base/text.h"
#include "cli/info.h"
#include "cli/json.h"
#include "colour/cct.h"
#include "colour/colour.h"
#include "colour/detector.h"
#include "spectrum/library.h"
#include "spectrum/projection.h"
#include "spectrum/resolver.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace spectrad {

namespace {

constexpr const char* daylightName = "illuminants/D65";

struct ChannelSummary {
    std::string name;
    std::optional<std::pair<double, double>> range;  ///< nm
    size_t samples = 0;
    double least = 0, most = 0;
    std::optional<double> integral;  ///< unit × nm; nothing for a curve without an end
};

struct LightColour {
    std::optional<std::array<double, 2>> xy, uv;
    std::optional<Cct> cct;
};
struct ObjectColour {
    Triple xyz, lab;  ///< white Y = 100
};

ChannelSummary summary(const std::string& channel, const Curve& curve) {
    ChannelSummary s{channel, curve.range(), curve.sampleWavelengths().size(), 0, 0, std::nullopt};
    std::tie(s.least, s.most) = curve.bounds();
    const std::array<const Curve*, 1> alone{&curve};
    if (s.range) s.integral = integrate(alone, s.range->first, s.range->second);
    return s;
}

bool isLight(Quantity quantity) {
    return quantity == Quantity::radiance || quantity == Quantity::irradiance ||
           quantity == Quantity::intensity || quantity == Quantity::power;
}

bool isObject(Quantity quantity) {
    return quantity == Quantity::reflectance || quantity == Quantity::transmittance;
}

LightColour lightColour(const Curve& light, const Detector& observer) {
    const std::array<const Curve*, 1> product{&light};
    const Triple xyz = respondXyz(observer, product);
    return {chromaticity(xyz), uvPrime(xyz), PlanckianLocus(observer).nearest(xyz)};
}

ObjectColour objectColour(const Curve& factor, const Curve& light, const Detector& observer) {
    const Curve held = factor.withOutside(Outside::hold);
    const std::array<const Curve*, 2> product{&held, &light};
    const std::array<const Curve*, 1> alone{&light};
    Triple white = respondXyz(observer, alone), xyz = respondXyz(observer, product);
    const double toHundred = 100 / white[1];
    for (size_t i = 0; i < 3; ++i) {
        white[i] *= toHundred;
        xyz[i] *= toHundred;
    }
    return {xyz, lab(xyz, white)};
}

struct Summary {
    std::vector<ChannelSummary> channels;
    std::optional<LightColour> light;
    std::optional<ObjectColour> object;
};

/// A quantity that the file does not state may be a light's, and a reflectance's too if it stays within 0…1.
Summary summarize(const Spectrum& spectrum, const Library& library, const SpectrumResolver& resolver) {
    Summary out;
    for (size_t i = 0; i < spectrum.curves.size(); ++i)
        out.channels.push_back(
            summary(i < spectrum.channels.size() ? spectrum.channels[i] : "", spectrum.curves[i]));
    if (spectrum.curves.size() != 1) return out;
    const bool unknown = spectrum.quantity == Quantity::unknown;
    const auto [least, most] = spectrum.curve().bounds();
    const Detector observer = standardObserver(library);
    if (isLight(spectrum.quantity) || (unknown && least >= 0))
        out.light = lightColour(spectrum.curve(), observer);
    if (isObject(spectrum.quantity) ||
        (unknown && least >= 0 && most <= 1 && spectrum.curve().lines().empty()))
        out.object =
            objectColour(spectrum.curve(), resolver.resolve(daylightName, Role::light, {}).curve(), observer);
    return out;
}

Json described(const Spectrum& spectrum, const Summary& summary) {
    Json out{{"text", spectrum.text},       {"quantity", name(spectrum.quantity)},
             {"unit", spectrum.unit},       {"relative", spectrum.relative},
             {"formula", spectrum.formula}, {"source", spectrum.source},
             {"licence", spectrum.licence}};
    out["channels"] = Json::array();
    for (const ChannelSummary& channel : summary.channels)
        out["channels"].push_back({{"name", channel.name},
                                   {"from_nm", channel.range ? Json(channel.range->first) : Json()},
                                   {"to_nm", channel.range ? Json(channel.range->second) : Json()},
                                   {"samples", channel.samples},
                                   {"min", channel.least},
                                   {"max", channel.most},
                                   {"integral", orNull(channel.integral)}});
    if (summary.light) {
        const LightColour& light = *summary.light;
        out["light"] = {{"xy", orNull(light.xy)},
                        {"uv_prime", orNull(light.uv)},
                        {"cct_K", light.cct ? Json(light.cct->kelvin) : Json()},
                        {"duv", light.cct ? Json(light.cct->duv) : Json()}};
    }
    if (summary.object) out["under_D65"] = {{"XYZ", summary.object->xyz}, {"Lab", summary.object->lab}};
    return out;
}

void printChannel(const Curve& curve, const ChannelSummary& channel, const std::string& unit) {
    const std::string label = channel.name.empty() ? "curve" : channel.name;
    printText(fmt::format("\n{}: ", label));
    if (channel.range)
        printText(fmt::format("{} to {} nm, ", rounded(channel.range->first, 9),
                              rounded(channel.range->second, 9)));
    else
        printText("at every wavelength, ");
    if (channel.samples) printText(fmt::format("{} samples, ", channel.samples));
    printText(fmt::format("values {} to {}", rounded(channel.least, 6), rounded(channel.most, 6)));
    if (channel.integral)
        printText(fmt::format(", integral {} {}nm", rounded(*channel.integral, 6),
                              unit.empty() || unit == "1" ? "" : unit + " x "));
    printText("\n");
    for (const SpectralLine& line : curve.lines())
        printText(
            fmt::format("line at {} nm, integral {}\n", rounded(line.nm, 9), rounded(line.integral, 6)));
    // Curves without an end, and those far beyond the visible, are shown around it.
    constexpr double nearFrom = 300, nearTo = 1100, wide = 2000;
    auto [from, to] = channel.range.value_or(std::pair{380.0, 780.0});
    if (to - from > wide && from < nearTo && to > nearFrom) {
        from = std::max(from, nearFrom);
        to = std::min(to, nearTo);
    }
    if (to - from < 1) {
        from -= 5;
        to += 5;
    }
    printText(plot(curve, from, to));
}

void printTable(const Spectrum& spectrum, const Summary& summary) {
    printText(fmt::format("spectrum  {}\n", spectrum.text));
    printText(
        fmt::format("quantity  {}{}\n", name(spectrum.quantity), spectrum.relative ? ", relative" : ""));
    if (!spectrum.unit.empty()) printText(fmt::format("unit      {}\n", spectrum.unit));
    if (!spectrum.source.empty()) printText(fmt::format("source    {}\n", spectrum.source));
    if (!spectrum.licence.empty()) printText(fmt::format("licence   {}\n", spectrum.licence));
    if (summary.light && summary.light->xy) {
        const LightColour& light = *summary.light;
        const std::string cct =
            light.cct ? fmt::format("CCT {:.0f} K, Duv {:.4f}", light.cct->kelvin, light.cct->duv)
                      : "no CCT (more than 0.05 from the Planckian locus)";
        printText(fmt::format("as light  x {:.4f}, y {:.4f}, u' {:.4f}, v' {:.4f}, {} (CIE 1931)\n",
                              (*light.xy)[0], (*light.xy)[1], (*light.uv)[0], (*light.uv)[1], cct));
    }
    if (summary.object) {
        const auto& [xyz, lab] = *summary.object;
        printText(
            fmt::format("under D65 XYZ {:.3f} {:.3f} {:.3f} (white Y = 100), L* {:.2f}, a* {:.2f}, b* {:.2f} "
                        "(CIE 1931)\n",
                        xyz[0], xyz[1], xyz[2], lab[0], lab[1], lab[2]));
    }
    for (size_t i = 0; i < summary.channels.size(); ++i)
        printChannel(spectrum.curves[i], summary.channels[i], spectrum.unit);
}

}  // namespace

void printSpectrumInfo(const std::string& text, const Library& library, bool json, Console& console) {
    const SpectrumResolver resolver(library, ".", false, console.notes());
    const Spectrum spectrum = resolver.resolve(text, Role::any, {});
    const Summary summary = summarize(spectrum, library, resolver);
    console.printNotes();
    if (json)
        printJson(described(spectrum, summary));
    else
        printTable(spectrum, summary);
}

}  // namespace spectrad
