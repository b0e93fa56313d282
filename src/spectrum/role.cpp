#include "spectrum/role.h"

#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>

namespace spectrad {

namespace {

std::string_view name(Role role) {
    static constexpr std::array<std::string_view, 8> names{
        "reflectance", "transmittance", "light", "detector", "index", "excitation", "emission", "any"};
    return names.at(static_cast<size_t>(role));
}

bool fits(Quantity quantity, Role role) {
    const auto among = [quantity](std::initializer_list<Quantity> allowed) {
        return std::find(allowed.begin(), allowed.end(), quantity) != allowed.end();
    };
    if (quantity == Quantity::unknown) return true;
    switch (role) {
        case Role::reflectance:
            return among({Quantity::reflectance});
        case Role::transmittance:
            return among({Quantity::transmittance});
        case Role::light:
            return among({Quantity::radiance, Quantity::irradiance, Quantity::intensity, Quantity::power});
        case Role::detector:
            return among({Quantity::sensitivity});
        case Role::index:
            return among({Quantity::index});
        // Shapes only: an absorbed fraction, a sensitivity, a glow in whatever unit it was measured.
        case Role::excitation:
            return among({Quantity::reradiation, Quantity::sensitivity, Quantity::transmittance,
                          Quantity::reflectance});
        case Role::emission:
            return among({Quantity::reradiation, Quantity::radiance, Quantity::irradiance,
                          Quantity::intensity, Quantity::power});
        case Role::any:
            return true;
    }
    return true;
}

std::string_view article(std::string_view word) {
    return std::string_view("aeiou").find(word.front()) != std::string_view::npos ? "an" : "a";
}

/// What a role allows of a curve's values.
struct Limits {
    double least, most;
    bool leastItself;  ///< false: values must be above `least`
};

Limits limitsOf(Role role, size_t channel) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    switch (role) {
        case Role::reflectance:
        case Role::transmittance:
            return {0, 1, true};
        case Role::light:
        case Role::excitation:
        case Role::emission:
            return {0, infinity, true};
        case Role::index:
            return {0, infinity, channel != 0};  // n > 0, k ≥ 0
        case Role::detector:
        case Role::any:
            break;
    }
    return {-infinity, infinity, true};
}

bool isWithin(double value, const Limits& limits) {
    return (limits.leastItself ? value >= limits.least : value > limits.least) && value <= limits.most;
}

/// A wavelength where the curve takes a value that is not within the limits, and the value.
std::optional<std::pair<double, double>> offence(const Curve& curve, const Limits& limits) {
    const auto [low, high] = curve.bounds();
    if (isWithin(low, limits) && isWithin(high, limits)) return std::nullopt;
    std::vector<double> nm(curve.sampleWavelengths().begin(), curve.sampleWavelengths().end());
    std::vector<double> value(curve.sampleValues().begin(), curve.sampleValues().end());
    if (nm.empty() && !curve.isConstant()) {
        const auto [from, to] = curve.range().value_or(std::pair{200.0, 20'000.0});
        nm.push_back(from);
        curve.appendBreaks(from, to, nm);
        nm.push_back(to);
        for (double lambda : nm)
            value.push_back(curve.at(lambda));
    }
    for (size_t i = 0; i < nm.size(); ++i)
        if (!isWithin(value[i], limits)) return std::pair{nm[i], value[i]};
    return std::pair{0.0, isWithin(low, limits) ? high : low};  // a constant: everywhere
}

std::string allowedText(Role role, size_t channel) {
    switch (role) {
        case Role::reflectance:
        case Role::transmittance:
            return "0 … 1";
        case Role::index:
            return channel == 0 ? "n above 0" : "k of 0 or more";
        default:
            return "0 or more";
    }
}

void checkValues(const Spectrum& spectrum, Role role, const SourceLocation& where) {
    for (size_t c = 0; c < spectrum.curves.size(); ++c) {
        const auto bad = offence(spectrum.curves[c], limitsOf(role, c));
        if (!bad) continue;
        const auto [nm, value] = *bad;
        const std::string place = nm > 0 ? fmt::format(" at {} nm", shortest(nm)) : "";
        const double largest = spectrum.curves[c].bounds().second;
        const bool share = role == Role::reflectance || role == Role::transmittance;
        const std::string percent = share && value > 0 && largest > 1.5 && largest <= 150
                                        ? "; the values look like percent: divide them by 100"
                                        : "";
        throw InputError(where, fmt::format("'{}' as {} {}: value {}{} (allowed: {}){}", spectrum.text,
                                            article(name(role)), name(role), shortest(value), place,
                                            allowedText(role, c), percent));
    }
}

void checkLines(const Spectrum& spectrum, Role role, const SourceLocation& where) {
    if (role == Role::light || role == Role::detector || role == Role::any) return;
    for (const Curve& curve : spectrum.curves)
        if (!curve.lines().empty())
            throw InputError(
                where,
                fmt::format(
                    "'{}' is a line of no width and cannot be {} {}; give it a width, as in line:{},0.01",
                    spectrum.text, article(name(role)), name(role), shortest(curve.lines().front().nm)));
}

void checkCount(const Spectrum& spectrum, Role role, const SourceLocation& where) {
    const size_t count = spectrum.curves.size();
    if (count == 0) throw InputError(where, fmt::format("'{}' has no values", spectrum.text));
    if (role == Role::index && count > 2)
        throw InputError(where, fmt::format("'{}' has {} columns, but an index has n, or n and k ({})",
                                            spectrum.text, count, fmt::join(spectrum.channels, ", ")));
    if (!takesChannels(role) && count > 1) {
        const std::string first = spectrum.channels.empty() ? "NAME" : spectrum.channels.front();
        throw InputError(
            where,
            fmt::format("'{}' holds {} spectra where one is meant; say which, as in '{}/{}' (there are: {})",
                        spectrum.text, count, spectrum.text, first, fmt::join(spectrum.channels, ", ")));
    }
}

}  // namespace

bool takesChannels(Role role) {
    return role == Role::detector || role == Role::index || role == Role::any;
}

std::optional<size_t> channelFor(Role role, const std::vector<std::string>& channels) {
    const auto found = std::find(channels.begin(), channels.end(), name(role));
    if (found == channels.end()) return std::nullopt;
    return static_cast<size_t>(found - channels.begin());
}

Spectrum fitted(Spectrum spectrum, Role role, const SourceLocation& where) {
    if (!fits(spectrum.quantity, role)) {
        const std::string_view is = spectrad::name(spectrum.quantity);
        throw InputError(where, fmt::format("'{}' has the quantity {} and cannot be {} {}", spectrum.text, is,
                                            article(name(role)), name(role)));
    }
    checkCount(spectrum, role, where);
    checkLines(spectrum, role, where);
    checkValues(spectrum, role, where);
    const bool shape = role == Role::excitation || role == Role::emission;
    if (shape && spectrum.curve().lines().empty() && spectrum.curve().bounds().second <= 0)
        throw InputError(where, fmt::format("'{}' is zero everywhere, but the shape of {} {} has a peak",
                                            spectrum.text, article(name(role)), name(role)));
    if (role == Role::any) return spectrum;
    const bool held = role == Role::reflectance || role == Role::transmittance || role == Role::index;
    for (Curve& curve : spectrum.curves)
        curve = curve.withOutside(held ? Outside::hold : Outside::zero);
    return spectrum;
}

}  // namespace spectrad
