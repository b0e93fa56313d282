#include "image/exr_bands.h"

#include "base/text.h"
#include "image/channel_names.h"
#include "image/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace spectrad {

namespace {

struct Found {
    double nm;
    std::string name;
};

/// The spectral channels of one group (the text before "S0." or "T.", "" for the layout's own).
struct Group {
    std::vector<Found> emissive, reflective;
    bool polarised = false, bispectral = false;
};

void add(Group& group, const SpectralChannel& channel, const std::string& name) {
    switch (channel.kind) {
        case SpectralChannel::Kind::emissive:
            if (channel.stokes == 0)
                group.emissive.push_back({channel.nm, name});
            else
                group.polarised = true;
            break;
        case SpectralChannel::Kind::reflective:
            group.reflective.push_back({channel.nm, name});
            break;
        case SpectralChannel::Kind::reradiation:
            group.bispectral = true;
            break;
    }
}

/// Splits "left.S0.380,0nm" into "left" and what the layout's grammar makes of the rest.
std::optional<std::pair<std::string, SpectralChannel>> parseGrouped(const std::string& name) {
    for (size_t dot = name.find('.'); dot != std::string::npos; dot = name.find('.', dot + 1))
        if (const auto channel = parseChannelName(std::string_view(name).substr(dot + 1)))
            return std::pair(name.substr(0, dot), *channel);
    return std::nullopt;
}

void checkBands(const std::vector<Found>& bands, const Imf::ChannelList& channels,
                const SourceLocation& where) {
    for (size_t j = 0; j < bands.size(); ++j) {
        const Found& band = bands[j];
        if (!std::isfinite(band.nm) || band.nm <= 0)
            throw InputError(where, "channel '" + printable(band.name) + "' has no wavelength above 0");
        const Imf::Channel& channel = channels[band.name];
        if (channel.xSampling != 1 || channel.ySampling != 1)
            throw InputError(where, fmt::format("channel '{}' is subsampled {}x{} (allowed: 1x1)",
                                                printable(band.name), channel.xSampling, channel.ySampling));
        // Two spellings of one wavelength may differ in the last place of a double (a frequency's division).
        constexpr double rounding = 1e-15;
        if (j > 0 && band.nm - bands[j - 1].nm <= rounding * band.nm)
            throw InputError(
                where, fmt::format("channels '{}' and '{}' are both {} nm", printable(bands[j - 1].name),
                                   printable(band.name), shortest(band.nm)));
    }
}

}  // namespace

ExrBands findBands(const Imf::ChannelList& channels, const std::filesystem::path& file, Notes& notes) {
    const SourceLocation where{file.string()};
    Group plain;
    std::map<std::string, Group> groups;
    std::vector<std::string> misspelt;
    for (auto it = channels.begin(); it != channels.end(); ++it) {
        const std::string name = it.name();
        if (const auto channel = parseChannelName(name))
            add(plain, *channel, name);
        else if (const auto grouped = parseGrouped(name))
            add(groups[grouped->first], grouped->second, name);
        else if (startsWith(name, "S0.") || startsWith(name, "T."))
            misspelt.push_back(name);
    }
    if (!misspelt.empty())
        notes.warn(where, fmt::format("{} channels are not of the spectral layout, '{}' for one; ignored",
                                      misspelt.size(), printable(misspelt.front())));

    Group* group = &plain;
    const auto filled = [](const auto& g) {
        return !g.second.emissive.empty() || !g.second.reflective.empty();
    };
    if (plain.emissive.empty() && plain.reflective.empty()) {
        const auto first = std::find_if(groups.begin(), groups.end(), filled);
        if (first != groups.end()) {
            group = &first->second;
            notes.warn(where, fmt::format("the channels of the group '{}' are read, of {} spectral groups",
                                          printable(first->first),
                                          std::count_if(groups.begin(), groups.end(), filled)));
        }
    }
    ExrBands bands;
    bands.emissive = !group->emissive.empty();
    std::vector<Found>& found = bands.emissive ? group->emissive : group->reflective;
    if (found.empty()) return bands;
    if (bands.emissive && !group->reflective.empty()) notes.warn(where, "both S0 and T channels; S0 is read");
    if (group->polarised) notes.warn(where, "polarised; S0 is read, the other Stokes components are not");
    if (group->bispectral) notes.warn(where, "bispectral; its diagonal is read, the reradiation is not");

    std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.nm < b.nm; });
    checkBands(found, channels, where);
    for (Found& band : found) {
        bands.nm.push_back(band.nm);
        bands.names.push_back(std::move(band.name));
    }
    return bands;
}

}  // namespace spectrad
