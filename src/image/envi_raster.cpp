#include "image/envi_raster.h"

#include "base/limits.h"
#include "base/text.h"
#include "image/cube_check.h"
#include "image/envi_units.h"
#include "image/exr_layout.h"
#include "image/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace spectrad::envi {

namespace {

constexpr std::array<std::pair<int, int>, 9> typeSizes{
    {{1, 1}, {2, 2}, {3, 4}, {4, 4}, {5, 8}, {12, 2}, {13, 4}, {14, 8}, {15, 8}}};

/// Keys that are read, or say nothing about the values; all others become attributes.
constexpr std::array<std::string_view, 24> readKeys{"samples",
                                                    "lines",
                                                    "bands",
                                                    "header offset",
                                                    "file type",
                                                    "data type",
                                                    "interleave",
                                                    "byte order",
                                                    "wavelength",
                                                    "wavelength units",
                                                    "fwhm",
                                                    "bbl",
                                                    "band names",
                                                    "default bands",
                                                    "default stretch",
                                                    "data units",
                                                    "data gain values",
                                                    "data offset values",
                                                    "reflectance scale factor",
                                                    "data ignore value",
                                                    "x start",
                                                    "y start",
                                                    "file compression",
                                                    "major frame offsets"};

Interleave interleaveOf(const Header& header, const SourceLocation& file) {
    const Field* field = header.find("interleave");
    if (!field) throw InputError(file, "'interleave' is missing");
    const std::string word = lowerCase(field->value);
    if (word == "bsq") return Interleave::bsq;
    if (word == "bil") return Interleave::bil;
    if (word == "bip") return Interleave::bip;
    throw InputError(header.where(*field),
                     "interleave '" + printable(field->value) + "' (allowed: bsq, bil, bip)");
}

/// What readers that go on would get wrong.
void refuseOtherFiles(const Header& header) {
    if (const Field* type = header.find("file type")) {
        const std::string word = lowerCase(type->value);
        if (word != "envi standard" && word != "envi" && !word.empty())
            throw InputError(header.where(*type),
                             "file type '" + printable(type->value) + "' (allowed: ENVI Standard)");
    }
    if (const Field* packed = header.find("file compression"); packed && packed->value != "0")
        throw InputError(header.where(*packed), "the data are compressed");
    for (const char* key : {"major frame offsets", "minor frame offsets"})
        for (double offset : header.numbers(key, 2))
            if (offset != 0)
                throw InputError(header.where(*header.find(key)), fmt::format("{} that are not 0", key));
}

/// Kind and scale of the values.
void readQuantity(const Header& header, Raster& raster, const SourceLocation& file, Notes& notes) {
    const Field* quantity = header.find(std::string(ourPrefix) + exr::quantity);
    if (quantity) {
        const auto kind = parseCubeKind(quantity->value);
        if (!kind)
            throw InputError(header.where(*quantity),
                             "quantity '" + printable(quantity->value) +
                                 "' (allowed: radiance, irradiance, reflectance, transmittance)");
        raster.info.kind = *kind;
    }
    if (const auto factor = header.number("reflectance scale factor")) {
        if (*factor <= 0)
            throw InputError(header.where(*header.find("reflectance scale factor")),
                             "a scale factor must be above 0");
        raster.scale = 1 / *factor;
        if (!quantity) raster.info.kind = CubeKind::reflectance;
        notes.say(fmt::format("{}: values are divided by the reflectance scale factor {}", file.file,
                              shortest(*factor)));
        return;
    }
    if (quantity) return;
    const Field* units = header.find("data units");
    if (!units) {
        notes.warn(file, "does not say what it holds; read as radiance in W/(m^2 sr nm)");
        return;
    }
    const auto factor = radianceUnit(units->value);
    if (!factor) {
        notes.warn(header.where(*units),
                   "data units '" + printable(units->value) + "' are read as W/(m^2 sr nm)");
        return;
    }
    raster.scale = *factor;
    if (raster.scale != 1)
        notes.say(fmt::format("{}: {} x {} = W/(m^2 sr nm)", file.file, printable(units->value),
                              shortest(raster.scale)));
}

/// Sorts the bands by wavelength.
void readWavelengths(const Header& header, size_t bands, Raster& raster, Notes& notes) {
    const std::vector<double> nm = wavelengthsNm(header, bands, notes);
    std::vector<size_t> sorted(bands);
    std::iota(sorted.begin(), sorted.end(), size_t(0));
    std::stable_sort(sorted.begin(), sorted.end(), [&](size_t a, size_t b) { return nm[a] < nm[b]; });
    raster.bandOrder.resize(bands);
    for (size_t j = 0; j < bands; ++j) {
        if (j > 0 && nm[sorted[j]] == nm[sorted[j - 1]])
            throw InputError(header.where(*header.find("wavelength")),
                             fmt::format("bands {} and {} are both {} nm", sorted[j - 1] + 1, sorted[j] + 1,
                                         shortest(nm[sorted[j]])));
        raster.bandOrder[sorted[j]] = j;
        raster.info.wavelengths.nm.push_back(nm[sorted[j]]);
    }
    Wavelengths& grid = raster.info.wavelengths;
    const Field* projection = header.find(std::string(ourPrefix) + exr::projection);
    raster.info.projectionStated = projection != nullptr;
    grid.projection = projection ? parseProjection(printable(projection->value), header.where(*projection))
                                 : Projection::point;
    if (const auto step = header.number(std::string(ourPrefix) + exr::step)) {
        if (*step <= 0)
            throw InputError(header.where(*header.find(std::string(ourPrefix) + exr::step)),
                             "a step must be above 0");
        grid.step = *step;
    }
    const std::vector<double> good = header.numbers("bbl", bands);
    if (const auto bad = std::count(good.begin(), good.end(), 0.0))
        notes.warn(header.where(*header.find("bbl")),
                   fmt::format("{} bands are marked as bad; all are read", bad));
}

void readAttributes(const Header& header, bool ourOwn, CubeInfo& info) {
    for (const Field& field : header.fields()) {
        const std::string key = lowerCase(field.key);
        if (std::find(readKeys.begin(), readKeys.end(), key) != readKeys.end()) continue;
        if (!startsWith(key, ourPrefix)) {
            if (key != "description" || !ourOwn) info.attributes[field.key] = field.value;
            continue;
        }
        const std::string name = decoded(std::string_view(field.key).substr(ourPrefix.size()));
        if (name != exr::quantity && name != exr::projection && name != exr::step)
            info.attributes[name] = decoded(field.value);
    }
}

}  // namespace

std::optional<int> bytesOfType(long long dataType) {
    for (const auto& [code, size] : typeSizes)
        if (code == dataType) return size;
    return std::nullopt;
}

Raster rasterFrom(const Header& header, const std::filesystem::path& file, Notes& notes) {
    const SourceLocation where{file.string()};
    constexpr long long mostPixels = std::numeric_limits<std::int32_t>::max();
    refuseOtherFiles(header);
    Raster raster;
    raster.info.width = static_cast<int>(header.integer("samples", 1, mostPixels));
    raster.info.height = static_cast<int>(header.integer("lines", 1, mostPixels));
    const auto bands = static_cast<size_t>(header.integer("bands", 1, maxBands));
    raster.offset = static_cast<std::uint64_t>(
        header.integer("header offset", 0, std::numeric_limits<long long>::max() / 2, 0));
    raster.dataType = static_cast<int>(header.integer("data type", 1, 15));
    if (!bytesOfType(raster.dataType))
        throw InputError(
            header.where(*header.find("data type")),
            fmt::format("data type {} (allowed: 1, 2, 3, 4, 5, 12, 13, 14, 15)", raster.dataType));
    raster.interleave = interleaveOf(header, where);
    // One byte has no order, and headers of such files may leave it out.
    raster.bigEndian =
        header.integer("byte order", 0, 1, raster.dataType == 1 ? std::optional(0LL) : std::nullopt) == 1;
    readWavelengths(header, bands, raster, notes);
    checkCubeInfo(raster.info, file);
    readQuantity(header, raster, where, notes);
    raster.gains = header.numbers("data gain values", bands);
    raster.offsets = header.numbers("data offset values", bands);
    if (!raster.gains.empty() || !raster.offsets.empty())
        notes.say(where.file + ": the header's gain and offset values are applied");
    if (raster.gains.empty()) raster.gains.assign(bands, 1);
    if (raster.offsets.empty()) raster.offsets.assign(bands, 0);
    if (const Field* ignored = header.find("data ignore value"))
        raster.ignored = lowerCase(ignored->value).find("nan") != std::string::npos
                             ? std::numeric_limits<double>::quiet_NaN()
                             : header.number("data ignore value");
    readAttributes(header, header.find(std::string(ourPrefix) + exr::quantity) != nullptr, raster.info);
    return raster;
}

}  // namespace spectrad::envi
