#include "image/curves.h"

#include "base/text.h"
#include "image/channel_names.h"
#include "image/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spectrad {

std::vector<CurveSample> parseCurveAttribute(std::string_view text, const SourceLocation& where) {
    std::vector<CurveSample> samples;
    for (std::string_view piece : split(text, ';')) {
        if (piece.empty()) continue;
        const size_t colon = piece.find(':');
        const auto nm = parseWave(trimmed(piece.substr(0, colon)), '.');
        const auto value =
            colon == std::string_view::npos ? std::nullopt : parseDouble(piece.substr(colon + 1));
        if (!nm || !value || !std::isfinite(*nm) || *nm <= 0 || *value < 0)
            throw InputError(where, fmt::format("'{}' is no sample of a curve (allowed: like 400nm:0.92)",
                                                printable(piece)));
        samples.push_back({*nm, *value});
    }
    if (samples.empty())
        throw InputError(where, "a curve without samples (allowed: like 400nm:0.92;410nm:0.93;)");
    std::stable_sort(samples.begin(), samples.end(),
                     [](const CurveSample& a, const CurveSample& b) { return a.nm < b.nm; });
    const auto same = [](const CurveSample& a, const CurveSample& b) {
        return a.nm == b.nm && a.value == b.value;
    };
    samples.erase(std::unique(samples.begin(), samples.end(), same), samples.end());
    for (size_t i = 1; i < samples.size(); ++i)
        if (samples[i].nm == samples[i - 1].nm)
            throw InputError(where, fmt::format("two values at {} nm in a curve", shortest(samples[i].nm)));
    return samples;
}

std::string curveAttribute(const std::vector<CurveSample>& samples) {
    std::string text;
    for (const CurveSample& sample : samples)
        text += fmt::format("{}nm:{};", shortest(sample.nm), shortest(sample.value));
    if (!samples.empty())
        text += fmt::format("{}nm:{}", shortest(samples.back().nm), shortest(samples.back().value));
    return text;
}

bool isCurveAttribute(std::string_view name) {
    if (name == "lensTransmission" || name == "cameraResponse" || name == "illuminant") return true;
    if (name == "X" || name == "Y" || name == "Z") return true;
    const auto channel = parseChannelName(name);
    return channel && channel->kind == SpectralChannel::Kind::emissive;
}

}  // namespace spectrad
