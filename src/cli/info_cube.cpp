// spectrad info CUBE: size, bands, what the values are, and their range.
#include "base/text.h"
#include "cli/info.h"
#include "image/cube.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spectrad {

namespace {

struct BandRange {
    float least = std::numeric_limits<float>::infinity(), most = -std::numeric_limits<float>::infinity();
    double mean = 0;
};

/// Each band's range; values that are not finite (other programs' files may hold some) are counted, not
/// ranged.
std::vector<BandRange> bandRanges(const Cube& cube, std::uint64_t& notFinite) {
    const size_t bands = cube.info.wavelengths.size();
    std::vector<BandRange> ranges(bands);
    std::vector<std::uint64_t> counted(bands);
    for (int y = 0; y < cube.info.height; ++y)
        for (size_t band = 0; band < bands; ++band) {
            const float* row = cube.row(y, band);
            BandRange& range = ranges[band];
            for (int x = 0; x < cube.info.width; ++x) {
                if (!std::isfinite(row[x])) {
                    ++notFinite;
                    continue;
                }
                range.least = std::min(range.least, row[x]);
                range.most = std::max(range.most, row[x]);
                range.mean += row[x];
                ++counted[band];
            }
        }
    for (size_t band = 0; band < bands; ++band)
        ranges[band].mean /= static_cast<double>(counted[band]);
    return ranges;
}

Json described(const Cube& cube, const std::vector<BandRange>& ranges, std::uint64_t notFinite) {
    const CubeInfo& info = cube.info;
    Json least = Json::array(), most = Json::array(), mean = Json::array();
    for (const BandRange& range : ranges) {
        least.push_back(range.least);
        most.push_back(range.most);
        mean.push_back(range.mean);
    }
    return {{"width", info.width},
            {"height", info.height},
            {"bands", info.wavelengths.size()},
            {"wavelengths_nm", info.wavelengths.nm},
            {"projection", name(info.wavelengths.projection)},
            {"projection_stated", info.projectionStated},
            {"kind", name(info.kind)},
            {"unit", unit(info.kind)},
            {"min", least},
            {"max", most},
            {"mean", mean},
            {"not_finite", notFinite},
            {"attributes", info.attributes}};
}

std::string spacing(const Wavelengths& grid) {
    if (grid.size() < 2) return "";
    double least = grid.nm[1] - grid.nm[0], most = least;
    for (size_t i = 2; i < grid.size(); ++i) {
        least = std::min(least, grid.nm[i] - grid.nm[i - 1]);
        most = std::max(most, grid.nm[i] - grid.nm[i - 1]);
    }
    if (most - least < 1e-6 * most) return fmt::format(", every {} nm", rounded(most, 6));
    return fmt::format(", {} to {} nm apart", rounded(least, 6), rounded(most, 6));
}

void printTable(const Cube& cube, const std::vector<BandRange>& ranges, std::uint64_t notFinite) {
    const CubeInfo& info = cube.info;
    const Wavelengths& grid = info.wavelengths;
    printText(fmt::format("size        {} x {} pixels\n", info.width, info.height));
    printText(fmt::format("bands       {}, {} to {} nm{}\n", grid.size(), rounded(grid.nm.front(), 9),
                          rounded(grid.nm.back(), 9), spacing(grid)));
    printText(fmt::format("values      {}{}{}\n", name(info.kind), unit(info.kind).empty() ? "" : ", ",
                          unit(info.kind)));
    printText(fmt::format("projection  {}{}\n", name(grid.projection),
                          info.projectionStated ? "" : " (not stated in the file)"));
    for (const auto& [key, value] : info.attributes)
        printText(fmt::format("{:<11} {}\n", key, value));
    if (notFinite) printText(fmt::format("not finite  {} values\n", notFinite));
    printText(fmt::format("\n{:>12} {:>13} {:>13} {:>13}\n", "nm", "min", "mean", "max"));
    for (size_t band = 0; band < grid.size(); ++band)
        printText(fmt::format("{:>12} {:>13} {:>13} {:>13}\n", rounded(grid.nm[band], 9),
                              rounded(ranges[band].least, 6), rounded(ranges[band].mean, 6),
                              rounded(ranges[band].most, 6)));
}

}  // namespace

void printCubeInfo(const std::string& file, bool json, Console& console) {
    const Cube cube = readCube(file, console.notes());
    console.printNotes();
    std::uint64_t notFinite = 0;
    const std::vector<BandRange> ranges = bandRanges(cube, notFinite);
    if (json)
        printJson(described(cube, ranges, notFinite));
    else
        printTable(cube, ranges, notFinite);
}

}  // namespace spectrad
