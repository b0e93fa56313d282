#include "colour/detector.h"

#include "spectrum/detector_product.h"
#include "spectrum/projection.h"

#include <algorithm>
#include <array>

namespace spectrad {

Detector detectorFrom(const Spectrum& spectrum) {
    Detector detector;
    detector.name = spectrum.text;
    detector.electrons = spectrum.electrons;
    detector.relative = spectrum.relative;
    for (const std::string& channel : spectrum.channels)
        detector.channels.push_back(channelName(channel));
    detector.channels.resize(spectrum.curves.size());
    for (size_t c = 0; c < detector.channels.size(); ++c) {
        // Files without headers, and headers that say the same twice, get numbers.
        std::string& channel = detector.channels[c];
        const auto before = detector.channels.begin() + static_cast<std::ptrdiff_t>(c);
        if (channel.empty() || std::find(detector.channels.begin(), before, channel) != before)
            channel = "channel" + std::to_string(c + 1);
        detector.response.push_back(spectrum.curves[c].withOutside(Outside::zero));
    }
    detector.tristimulus = detector.channels == std::vector<std::string>{"X", "Y", "Z"};
    // Without light at 540 THz a V has no lumens, and stays in plain units.
    const std::optional<double> efficacy = efficacyOf(spectrum);
    detector.luminous = efficacy && detector.channels == std::vector<std::string>{"V"};
    if (detector.tristimulus || detector.luminous) detector.scale = efficacy.value_or(luminousEfficacy);
    return detector;
}

Detector detectorFor(const std::string& text, const SpectrumResolver& resolver, const SourceLocation& where) {
    return detectorFrom(detectorSpectrum(text, resolver, where));
}

Detector standardObserver(const Library& library) {
    const auto spectrum = library.find("observers/cie1931-2");
    if (!spectrum)
        throw InputError("the library " + library.folder().string() +
                         " has no observers/cie1931-2, which colorimetry needs");
    return detectorFrom(*spectrum);
}

DetectorWeights weightsOn(const Wavelengths& grid, const Detector& detector) {
    DetectorWeights result;
    for (const Curve& response : detector.response) {
        result.weights.push_back(detectorWeights(grid, response));
        for (double& weight : result.weights.back())
            weight *= detector.scale;
    }
    return result;
}

std::vector<double> respond(const Detector& detector, std::span<const Curve* const> product) {
    std::vector<const Curve*> factors(product.begin(), product.end());
    factors.push_back(nullptr);
    std::vector<double> channels;
    for (const Curve& response : detector.response) {
        factors.back() = &response;
        channels.push_back(detector.scale * integrate(factors));
    }
    return channels;
}

std::array<double, 3> respondXyz(const Detector& detector, std::span<const Curve* const> product) {
    if (!detector.tristimulus)
        throw InputError("XYZ need an observer with the channels X, Y, Z, not '" + detector.name + "'");
    const std::vector<double> channels = respond(detector, product);
    return {channels[0], channels[1], channels[2]};
}

}  // namespace spectrad
