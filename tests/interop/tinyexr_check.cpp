// Reads cubes with tinyexr, a decoder that shares no code with OpenEXR, and compares them with their .json.
// Its lists are plain: "key": [numbers], so that no JSON library is needed. Exit code 1: a difference.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <tinyexr.h>
#include <vector>

namespace {

std::string textOf(const std::string& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The number after the next "key": from `at` on, which moves behind it.
double numberAfter(const std::string& json, const std::string& key, size_t& at) {
    at = json.find("\"" + key + "\":", at);
    if (at == std::string::npos) throw std::runtime_error("no " + key);
    at += key.size() + 3;
    return std::strtod(json.c_str() + at, nullptr);
}

/// The list after the next "key": from `at` on.
std::vector<double> listAfter(const std::string& json, const std::string& key, size_t& at) {
    at = json.find('[', json.find("\"" + key + "\":", at)) + 1;
    std::vector<double> list;
    for (const size_t end = json.find(']', at); at < end; at = json.find_first_of(",]", at) + 1)
        list.push_back(std::strtod(json.c_str() + at, nullptr));
    return list;
}

void require(bool fine, const std::string& what) {
    if (!fine) throw std::runtime_error(what);
}

void check(const std::string& path) {
    EXRVersion version;
    EXRHeader header;
    EXRImage image;
    InitEXRHeader(&header);
    InitEXRImage(&image);
    const char* error = nullptr;
    require(ParseEXRVersionFromFile(&version, path.c_str()) == TINYEXR_SUCCESS, "no EXR version");
    require(ParseEXRHeaderFromFile(&header, &version, path.c_str(), &error) == TINYEXR_SUCCESS,
            error ? error : "no header");
    for (int c = 0; c < header.num_channels; ++c)
        header.requested_pixel_types[c] = TINYEXR_PIXELTYPE_FLOAT;
    require(LoadEXRImageFromFile(&image, &header, path.c_str(), &error) == TINYEXR_SUCCESS,
            error ? error : "no image");

    std::map<double, const float*> bands;
    for (int c = 0; c < header.num_channels; ++c) {
        std::string name = header.channels[c].name;
        if (name.rfind("S0.", 0) != 0 && name.rfind("T.", 0) != 0) continue;
        std::replace(name.begin(), name.end(), ',', '.');
        bands[std::strtod(name.c_str() + name.find('.') + 1, nullptr)] =
            reinterpret_cast<const float*>(image.images[c]);
    }
    const std::string json = textOf(path.substr(0, path.rfind('.')) + ".json");
    size_t at = 0;
    require(numberAfter(json, "width", at) == image.width && numberAfter(json, "height", at) == image.height,
            "wrong size");
    const std::vector<double> wavelengths = listAfter(json, "wavelengths_nm", at);
    require(wavelengths.size() == bands.size(), "wrong number of bands");
    size_t b = 0;
    for (const auto& [nm, plane] : bands)
        require(std::abs(nm - wavelengths[b++]) < 1e-6, "wrong wavelengths");
    int samples = 0;
    while (json.find("\"x\":", at) != std::string::npos) {
        const int x = static_cast<int>(numberAfter(json, "x", at)),
                  y = static_cast<int>(numberAfter(json, "y", at));
        const std::vector<double> values = listAfter(json, "values", at);
        b = 0;
        for (const auto& [nm, plane] : bands)
            require(plane[y * image.width + x] == values[b++],
                    "wrong value at " + std::to_string(nm) + " nm");
        ++samples;
    }
    require(samples > 0, "nothing compared");
    std::cout << path << ": " << image.width << "x" << image.height << ", " << bands.size()
              << " bands as written\n";
    FreeEXRImage(&image);
    FreeEXRHeader(&header);

    // What a viewer of ordinary pictures does.
    float* rgba = nullptr;
    int width = 0, height = 0;
    require(LoadEXR(&rgba, &width, &height, path.c_str(), &error) == TINYEXR_SUCCESS,
            error ? error : "no preview");
    require(rgba[0] == 0.25f, "wrong preview");
    std::free(rgba);
}

}  // namespace

int main(int count, char** paths) {
    for (int i = 1; i < count; ++i) {
        try {
            check(paths[i]);
        } catch (const std::exception& error) {
            std::cerr << paths[i] << ": " << error.what() << "\n";
            return 1;
        }
    }
    return count > 1 ? 0 : 1;
}
