// Which channels of an EXR file are the bands of its cube.
#pragma once

#include "base/error.h"

#include <ImfChannelList.h>

#include <filesystem>
#include <string>
#include <vector>

namespace spectrad {

/// The bands of one part, in ascending order of wavelength, whatever the order and spelling of their names.
struct ExrBands {
    bool emissive = true;            ///< S0 channels; else T
    std::vector<std::string> names;  ///< empty if the part has none
    std::vector<double> nm;
};

/// S0 before T where both are there; where neither is, those of the first group "<group>.S0.…". What is left
/// aside is said in `notes`. Throws InputError for two channels of one wavelength, a wavelength that is none,
/// a subsampled channel.
[[nodiscard]] ExrBands findBands(const Imf::ChannelList& channels, const std::filesystem::path& file,
                                 Notes& notes);

}  // namespace spectrad
