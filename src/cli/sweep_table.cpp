#include "cli/sweep_table.h"

#include "base/text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace spectrad {

namespace {

std::vector<double> meanOf(const ChannelImage& image, const MeasuredRegion& region) {
    std::vector<double> mean;
    for (const std::vector<double>& plane : image.plane) {
        double sum = 0;
        for (const size_t pixel : region.pixels)
            sum += plane[pixel];
        mean.push_back(sum / static_cast<double>(region.pixels.size()));
    }
    return mean;
}

/// As CSV wants it: in quotes where it holds commas or quotes.
std::string field(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"') out += '"';
        out += c;
    }
    return out + "\"";
}

}  // namespace

Json sweepRow(const SweepImage& image, const MeasuredRegion& region) {
    const std::vector<double> mean = meanOf(image.channels, region);
    const Triple xyz = image.eye.xyz(mean, image.metered);
    Json row{{"variant", image.variant},
             {"detector", image.detector},
             {"region", region.name},
             {"pixels", region.pixels.size()},
             {"XYZ", xyz}};
    const auto xy = chromaticity(xyz);
    row["xy"] = xy ? Json(*xy) : Json();
    const Triple& white = image.white.xyz;
    row["Lab"] = *std::min_element(white.begin(), white.end()) > 0 ? Json(lab(xyz, white)) : Json();
    const std::vector<std::string>& channels = image.eye.detector().channels;
    for (size_t c = 0; c < mean.size(); ++c)
        row["channels"][channels[c]] = mean[c];
    return row;
}

std::string sweepCsv(const Json& rows) {
    std::string text = "variant,detector,region,X,Y,Z,x,y,L,a,b\n";
    for (const Json& row : rows) {
        text += fmt::format("{},{},{}", field(row.at("variant").get<std::string>()),
                            field(row.at("detector").get<std::string>()),
                            field(row.at("region").get<std::string>()));
        for (const auto& [key, count] : {std::pair{"XYZ", 3}, std::pair{"xy", 2}, std::pair{"Lab", 3}})
            for (int i = 0; i < count; ++i)
                text += row.at(key).is_null()
                            ? ","
                            : "," + rounded(row.at(key)[static_cast<size_t>(i)].get<double>(), 9);
        text += '\n';
    }
    return text;
}

}  // namespace spectrad
