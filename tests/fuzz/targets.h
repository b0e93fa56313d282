// Every parser of what strangers send, as a function of bytes: whatever they are, it returns, or throws an
// Error of one line.
#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace spectrad::fuzz {

struct Target {
    std::string_view name;  ///< and the folder of its corpus
    std::function<void(std::string_view bytes)> run;
};
/// scene: XML; table: text files of spectra, films; words: spectra, wavelengths, detectors, --set as options
/// state them; exr, envi, png, jpeg.
[[nodiscard]] const std::vector<Target>& targets();

}  // namespace spectrad::fuzz
