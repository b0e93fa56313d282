#include "spectrum/efficacy.h"

#include "base/text.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace spectrad {

namespace {

/// CIE 015:2018 and CIE 170-2:2015, to their last digit. A deficient eye's X, Y, Z are a normal eye's of 2015
/// who sees the same.
constexpr std::array<std::pair<std::string_view, double>, 12> published{
    {{"cie1931-2", luminousEfficacy},
     {"cie1924-photopic", luminousEfficacy},
     {"cie1964-10", 683.599},
     {"cie2015-2", 683.358},
     {"cie2008-photopic-2", 683.358},
     {"protanope", 683.358},
     {"deuteranope", 683.358},
     {"tritanope", 683.358},
     {"cie2015-10", 683.144},
     {"cie2008-photopic-10", 683.144},
     {"protanomalous-10", 683.144},
     {"deuteranomalous-10", 683.144}}};

constexpr double candelaNm = 555.016;  // 540 THz in standard air, as the tables are

}  // namespace

std::string channelName(std::string_view header) {
    std::string_view stem = trimmed(header);
    for (std::string_view tail : {"_bar", "-bar", " bar", "bar"})
        if (stem.size() == tail.size() + 1 && stem.substr(1) == tail) stem = stem.substr(0, 1);
    std::string result(stem);
    if (result.size() == 1 && result[0] >= 'a' && result[0] <= 'z')
        result[0] = static_cast<char>(result[0] - 'a' + 'A');
    return result;
}

std::optional<double> efficacyOf(const Spectrum& sensitivity) {
    if (sensitivity.efficacy) return sensitivity.efficacy;
    std::vector<std::string> channels;
    for (const std::string& channel : sensitivity.channels)
        channels.push_back(channelName(channel));
    const bool luminous = channels == std::vector<std::string>{"V"};
    if (!luminous && channels != std::vector<std::string>{"X", "Y", "Z"}) return std::nullopt;
    const std::string_view text = sensitivity.text, name = text.substr(text.rfind('/') + 1);
    const auto known = std::find_if(published.begin(), published.end(),
                                    [&](const auto& entry) { return entry.first == name; });
    if (known != published.end()) return known->second;
    if (!luminous) return luminousEfficacy;
    const double there = sensitivity.curve().at(candelaNm);
    return there > 0 ? std::optional(683 / there) : std::nullopt;
}

}  // namespace spectrad
