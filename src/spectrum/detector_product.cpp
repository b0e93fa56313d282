#include "spectrum/detector_product.h"

#include "base/text.h"
#include "spectrum/efficacy.h"
#include "spectrum/si.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace spectrad {

namespace {

constexpr std::string_view quantumPrefix = "qe:";
constexpr const char* example =
    "as in 'qe:sensors/ccd * filters/ir-cut * (R = filters/red, G = filters/green)'";

/// Photons per joule at a wavelength in nm: λ/hc.
double photonsPerJoule(double nm) {
    return nm * 1e-9 / (planckConstant * speedOfLight);
}

/// Pieces between `separator`, but for those inside parentheses.
std::vector<std::string_view> outerPieces(std::string_view text, char separator,
                                          const SourceLocation& where) {
    std::vector<std::string_view> pieces;
    int depth = 0;
    size_t from = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '(') ++depth;
        if (text[i] == ')' && --depth < 0) break;
        if (text[i] != separator || depth != 0) continue;
        pieces.push_back(trimmed(text.substr(from, i - from)));
        from = i + 1;
    }
    if (depth != 0)
        throw InputError(
            where, fmt::format("the detector '{}' has parentheses that do not match ({})", text, example));
    pieces.push_back(trimmed(text.substr(from)));
    return pieces;
}

DetectorFactor factorOf(std::string_view piece, std::string_view whole, const SourceLocation& where) {
    const bool quantum = startsWith(piece, quantumPrefix);
    if (quantum) piece = trimmed(piece.substr(quantumPrefix.size()));
    if (piece.empty())
        throw InputError(where, fmt::format("the detector '{}' has an empty factor ({})", whole, example));
    return {std::string(piece), quantum, where};
}

std::vector<DetectorProduct::Channel> channelsOf(std::string_view list, const SourceLocation& where) {
    std::vector<DetectorProduct::Channel> channels;
    // A formula's own comma ("gaussian:450,20") begins nothing: channels do where a name and = stand.
    std::vector<std::string> entries;
    for (const std::string_view piece : outerPieces(list, ',', where)) {
        if (entries.empty() || piece.find('=') != std::string_view::npos)
            entries.emplace_back(piece);
        else
            entries.back() += "," + std::string(piece);
    }
    for (const std::string_view entry : entries) {
        const size_t equals = entry.find('=');
        if (equals == std::string_view::npos || trimmed(entry.substr(0, equals)).empty())
            throw InputError(where,
                             fmt::format("'{}' is no channel: NAME = FACTOR is meant ({})", entry, example));
        DetectorProduct::Channel channel{std::string(trimmed(entry.substr(0, equals))), {}};
        for (const std::string_view piece : outerPieces(entry.substr(equals + 1), '*', where))
            channel.factors.push_back(factorOf(piece, entry, where));
        channels.push_back(std::move(channel));
    }
    return channels;
}

struct Resolved {
    std::vector<Curve> curves;
    std::vector<std::string> names;
    bool sensor = false;  ///< what makes light a signal, and so is blind outside its range
};

/// A photon frees one electron at most.
void checkQuantumEfficiency(const Spectrum& spectrum, const DetectorFactor& factor) {
    constexpr double rounding = 1e-6;
    for (const Curve& curve : spectrum.curves) {
        const double most = curve.bounds().second;
        if (most > 1 + rounding)
            throw InputError(
                factor.where,
                fmt::format(
                    "'{}' as a quantum efficiency: value {} (allowed: at most 1){}", factor.text,
                    shortest(most),
                    most > 1.5 && most <= 150 ? "; the values look like percent: divide them by 100" : ""));
    }
}

class Multiplier {
  public:
    Multiplier(const SpectrumResolver& resolver, Spectrum& out) : resolver_(resolver), out_(out) {}

    Resolved resolve(const DetectorFactor& factor) {
        // Cameras of the library need no folder before their names, here as elsewhere.
        const bool bareName = factor.quantum && factor.text.find_first_of("/:.") == std::string::npos;
        Spectrum spectrum =
            resolver_.resolve(factor.text, bareName ? Role::detector : Role::any, factor.where);
        const bool filter =
            spectrum.quantity == Quantity::transmittance || spectrum.quantity == Quantity::reflectance;
        if (filter && factor.quantum)
            throw InputError(factor.where, fmt::format("'{}' is a {}, no quantum efficiency", factor.text,
                                                       name(spectrum.quantity)));
        const Role role = spectrum.quantity == Quantity::reflectance ? Role::reflectance
                          : filter                                   ? Role::transmittance
                                                                     : Role::detector;
        spectrum = resolver_.checked(std::move(spectrum), role, factor.where);
        if (role == Role::detector)
            if (const auto efficacy = efficacyOf(spectrum)) out_.efficacy = efficacy;
        out_.files.insert(out_.files.end(), spectrum.files.begin(), spectrum.files.end());
        out_.relative = out_.relative || spectrum.relative;
        if (factor.quantum) checkQuantumEfficiency(spectrum, factor);
        if (factor.quantum && isBare(spectrum)) endless_ = factor.text;
        if (factor.quantum)
            for (Curve& curve : spectrum.curves)
                curve = Curve::formula([curve](double nm) { return curve.at(nm) * photonsPerJoule(nm); },
                                       [curve](double from, double to, std::vector<double>& breaks) {
                                           curve.appendBreaks(from, to, breaks);
                                       },
                                       curve.range());
        return {spectrum.curves, spectrum.channels, !filter && !isBare(spectrum)};
    }

    /// The last quantum efficiency that has no range, as the user wrote it; empty: none.
    [[nodiscard]] const std::string& endless() const { return endless_; }

  private:
    /// A number or a formula that goes on for ever says nothing about where a sensor ends.
    static bool isBare(const Spectrum& spectrum) { return !spectrum.curve().range().has_value(); }

    const SpectrumResolver& resolver_;
    Spectrum& out_;
    std::string endless_;
};

/// The product on the range where no sensor is blind. Between the samples of all its factors it is a
/// polynomial, of a degree that the quadrature integrates exactly for up to seven of them.
Curve productOf(const std::vector<Curve>& curves) {
    if (curves.size() == 1) return curves.front();
    std::pair<double, double> range{0, std::numeric_limits<double>::infinity()};
    for (const Curve& curve : curves)
        if (const auto own = curve.support())
            range = {std::max(range.first, own->first), std::min(range.second, own->second)};
    if (!(range.first < range.second)) return Curve::table({range.first}, {0});
    return Curve::formula(
        [curves](double nm) {
            double product = 1;
            for (const Curve& curve : curves)
                product *= curve.at(nm);
            return product;
        },
        [curves](double from, double to, std::vector<double>& breaks) {
            std::vector<double> all;
            for (const Curve& curve : curves)
                curve.appendBreaks(from, to, all);
            std::sort(all.begin(), all.end());
            all.erase(std::unique(all.begin(), all.end()), all.end());
            breaks.insert(breaks.end(), all.begin(), all.end());
        },
        range);
}

}  // namespace

bool isDetectorProduct(std::string_view text) {
    return text.find('*') != std::string_view::npos || startsWith(trimmed(text), quantumPrefix);
}

DetectorProduct parseDetectorProduct(std::string_view text, const SourceLocation& where) {
    DetectorProduct product;
    for (const std::string_view piece : outerPieces(text, '*', where)) {
        if (!startsWith(piece, "(")) {
            product.common.push_back(factorOf(piece, text, where));
            continue;
        }
        if (!product.channels.empty())
            throw InputError(where,
                             fmt::format("the detector '{}' has two lists of channels ({})", text, example));
        product.channels = channelsOf(piece.substr(1, piece.size() - 2), where);
    }
    return product;
}

Spectrum multiplied(const DetectorProduct& product, const std::string& text, const SpectrumResolver& resolver,
                    const SourceLocation& where) {
    Spectrum out;
    out.text = text;
    out.quantity = Quantity::sensitivity;
    Multiplier multiplier(resolver, out);
    std::vector<Curve> common;
    Resolved several;
    bool sensor = false, electrons = false;
    for (const DetectorFactor& factor : product.common) {
        Resolved resolved = multiplier.resolve(factor);
        sensor = sensor || resolved.sensor;
        electrons = electrons || factor.quantum;
        if (resolved.curves.size() == 1) {
            common.push_back(resolved.curves.front());
            continue;
        }
        if (!several.curves.empty() || !product.channels.empty())
            throw InputError(factor.where,
                             fmt::format("'{}' has {} channels, and so has another factor of the detector "
                                         "(allowed: one)",
                                         factor.text, resolved.curves.size()));
        several = std::move(resolved);
    }
    const auto add = [&](const std::string& channel, std::vector<Curve> own) {
        own.insert(own.end(), common.begin(), common.end());
        out.channels.push_back(channel);
        out.curves.push_back(productOf(own));
    };
    for (size_t c = 0; c < several.curves.size(); ++c)
        add(c < several.names.size() ? several.names[c] : "", {several.curves[c]});
    bool everyChannel = !product.channels.empty(), everyElectrons = everyChannel;
    for (const DetectorProduct::Channel& channel : product.channels) {
        if (std::find(out.channels.begin(), out.channels.end(), channel.name) != out.channels.end())
            throw InputError(where, fmt::format("the detector has the channel '{}' twice", channel.name));
        std::vector<Curve> own;
        bool ownSensor = false, ownElectrons = false;
        for (const DetectorFactor& factor : channel.factors) {
            const Resolved resolved = multiplier.resolve(factor);
            if (resolved.curves.size() != 1)
                throw InputError(factor.where, fmt::format("'{}' has {} channels where one is meant",
                                                           factor.text, resolved.curves.size()));
            own.push_back(resolved.curves.front());
            ownSensor = ownSensor || resolved.sensor;
            ownElectrons = ownElectrons || factor.quantum;
        }
        everyChannel = everyChannel && ownSensor;
        everyElectrons = everyElectrons && ownElectrons;
        add(channel.name, std::move(own));
    }
    if (out.curves.empty()) add("signal", {});
    out.electrons = electrons || everyElectrons;
    if (!sensor && !everyChannel && !multiplier.endless().empty())
        throw InputError(where,
                         fmt::format("the quantum efficiency '{}' goes on for ever: a sensor has a range, "
                                     "as 'qe:300:0.5 1100:0.5'",
                                     multiplier.endless()));
    if (!sensor && !everyChannel)
        throw InputError(where,
                         fmt::format("the detector '{}' is all filters and no sensor (a curve of quantity "
                                     "sensitivity, or qe:CURVE)",
                                     text));
    return out;
}

Spectrum detectorSpectrum(const std::string& text, const SpectrumResolver& resolver,
                          const SourceLocation& where) {
    if (!isDetectorProduct(text)) return resolver.resolve(text, Role::detector, where);
    return multiplied(parseDetectorProduct(text, where), text, resolver, where);
}

}  // namespace spectrad
