#include "image/exr_layout.h"

#include "base/text.h"
#include "image/curves.h"
#include "image/exr_limits.h"
#include "image/printable.h"

#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFloatAttribute.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace spectrad {

namespace {

/// What the layout says of a unit leaves out the "per nm" that it means; an attribute of ours says it whole.
struct EmissiveKind {
    CubeKind kind;
    const char* layoutUnit;
    const char* unitAttribute;
};
constexpr std::array<EmissiveKind, 2> emissiveKinds{
    {{CubeKind::radiance, "W.m^-2.sr^-1", "spectralRadianceUnits"},
     {CubeKind::irradiance, "W.m^-2", "spectralIrradianceUnits"}}};

std::string ours(std::string_view name) {
    return std::string(exr::ourPrefix).append(name);
}

bool isOwnName(std::string_view name) {
    return name == exr::projection || name == exr::step || name == exr::wavelengths || name == exr::quantity;
}

/// Attributes of a cube that keep their name in the file: the layout's curves and the standard's texts.
bool keepsItsName(std::string_view name) {
    static constexpr std::array<std::string_view, 5> standard{"software", "comments", "owner", "capDate",
                                                              "polarisationHandedness"};
    return std::find(standard.begin(), standard.end(), name) != standard.end() || isCurveAttribute(name);
}

std::string_view projectionWords(Projection projection) {
    switch (projection) {
        case Projection::slit:
            return "averages under hats that reach to the neighbouring wavelengths";
        case Projection::box:
            return "averages over bands that reach half-way to the neighbouring wavelengths";
        case Projection::point:
            break;
    }
    return "the values at the wavelengths";
}

Imf::Compression exrCompression(Compression compression) {
    switch (compression) {
        case Compression::zips:
            return Imf::ZIPS_COMPRESSION;
        case Compression::zip:
            return Imf::ZIP_COMPRESSION;
        case Compression::piz:
            return Imf::PIZ_COMPRESSION;
        case Compression::none:
            break;
    }
    return Imf::NO_COMPRESSION;
}

/// A wavelength as far as the six decimals of a name give it.
double asNamed(double nm) {
    return parseDouble(fmt::format("{:.6f}", nm)).value_or(nm);
}

const std::string* findText(const Imf::Header& header, const std::string& name) {
    const auto* attribute = header.findTypedAttribute<Imf::StringAttribute>(name);
    return attribute ? &attribute->value() : nullptr;
}

/// The exact wavelengths that our writer adds where the names do not hold them, if they still belong to these
/// channels.
std::optional<std::vector<double>> exactWavelengths(const Imf::Header& header,
                                                    const std::vector<double>& fromNames) {
    const std::string* text = findText(header, ours(exr::wavelengths));
    if (!text) return std::nullopt;
    std::vector<double> nm;
    for (std::string_view word : words(*text)) {
        const auto value = parseDouble(word);
        constexpr double halfADecimal = 0.51e-6;
        if (!value || nm.size() == fromNames.size() ||
            std::abs(*value - fromNames[nm.size()]) > halfADecimal || (!nm.empty() && *value <= nm.back()))
            return std::vector<double>();
        nm.push_back(*value);
    }
    if (nm.size() != fromNames.size()) nm.clear();
    return nm;
}

}  // namespace

void addText(Imf::Header& header, const std::string& name, const std::string& value,
             const std::filesystem::path& file) {
    if (name.empty() || name.size() > longestName)
        throw InputError({file.string()},
                         fmt::format("attribute '{}' has a name of {} bytes (allowed: 1 to {})", name,
                                     name.size(), longestName));
    if (header.find(name) != header.end())
        throw InputError({file.string()}, fmt::format("attribute '{}' is the file's own", name));
    header.insert(name, Imf::StringAttribute(value));
}

Imf::Header cubeHeader(const CubeInfo& info, const WriteOptions& options,
                       const std::vector<std::string>& bands, const std::filesystem::path& file) {
    Imf::Header header(info.width, info.height);
    header.compression() = exrCompression(options.compression);
    // One type for all: some readers take every channel in the type of the first.
    const Imf::Channel channel(options.half ? Imf::HALF : Imf::FLOAT);
    for (const std::string& band : bands)
        header.channels().insert(band, channel);
    for (const char* colour : {"R", "G", "B"})
        header.channels().insert(colour, channel);

    header.insert(exr::layoutVersion, Imf::StringAttribute("1.0"));
    for (const EmissiveKind& emissive : emissiveKinds)
        if (emissive.kind == info.kind) {
            header.insert(exr::emissiveUnits, Imf::StringAttribute(emissive.layoutUnit));
            header.insert(emissive.unitAttribute, Imf::StringAttribute(std::string(unit(info.kind))));
        }
    header.insert("EV", Imf::FloatAttribute(0));            // the preview is what was computed × 2^EV
    Imf::addChromaticities(header, Imf::Chromaticities());  // Rec. 709 and D65

    const Wavelengths& grid = info.wavelengths;
    header.insert(ours(exr::quantity), Imf::StringAttribute(std::string(name(info.kind))));
    header.insert(ours(exr::projection), Imf::StringAttribute(std::string(name(grid.projection))));
    header.insert(ours(exr::step), Imf::StringAttribute(shortest(grid.step)));
    if (std::any_of(grid.nm.begin(), grid.nm.end(), [](double nm) { return asNamed(nm) != nm; })) {
        std::string list;
        for (double nm : grid.nm)
            list += (list.empty() ? "" : " ") + shortest(nm);
        header.insert(ours(exr::wavelengths), Imf::StringAttribute(list));
    }

    for (const auto& [key, value] : info.attributes) {
        if (isCurveAttribute(key))
            addText(header, key, curveAttribute(parseCurveAttribute(value, {file.string() + ": " + key})),
                    file);
        else
            addText(header, keepsItsName(key) ? key : ours(key), value, file);
    }
    if (!info.attributes.contains("software")) addText(header, "software", "Spectrad", file);
    if (!info.attributes.contains("comments"))
        addText(header, "comments",
                fmt::format("Spectral {}{}{}; the bands are {}.", name(info.kind),
                            unit(info.kind).empty() ? "" : " in ", unit(info.kind),
                            projectionWords(grid.projection)),
                file);
    return header;
}

CubeInfo cubeInfoFrom(const Imf::Header& header, bool emissive, std::vector<double> fromNames,
                      const std::filesystem::path& file, Notes& notes) {
    const SourceLocation where{file.string()};
    CubeInfo info;
    const Imath::Box2i& window = header.dataWindow();
    const long long width = 1LL + window.max.x - window.min.x, height = 1LL + window.max.y - window.min.y;
    if (width > std::numeric_limits<int>::max() || height > std::numeric_limits<int>::max())
        throw InputError(where, fmt::format("a data window of {}x{} pixels", width, height));
    info.width = static_cast<int>(width);
    info.height = static_cast<int>(height);
    if (window != header.displayWindow())
        notes.say(fmt::format("{}: the data window is read, {}x{} pixels from {},{}, not the display window",
                              where.file, width, height, window.min.x, window.min.y));

    const std::string* version = findText(header, exr::layoutVersion);
    if (!version || *version != "1.0")
        notes.warn(where, version ? "spectralLayoutVersion is '" + printable(*version) + "', read as 1.0"
                                  : "no spectralLayoutVersion, read as 1.0");
    info.kind = emissive ? CubeKind::radiance : CubeKind::reflectance;
    const std::string* quantity = findText(header, ours(exr::quantity));
    const std::string* units = findText(header, exr::emissiveUnits);
    if (quantity) {
        const auto kind = parseCubeKind(*quantity);
        if (!kind || unit(*kind).empty() == emissive)
            throw InputError(
                where, "spectrad:quantity is '" + printable(*quantity) + "', which its channels are not");
        info.kind = *kind;
    } else if (emissive && units && (*units == "W.m^-2" || *units == "W.m^-2.nm^-1")) {
        info.kind = CubeKind::irradiance;
    } else if (emissive && (!units || (*units != "W.m^-2.sr^-1" && *units != "W.m^-2.sr^-1.nm^-1"))) {
        notes.warn(where, (units ? "emissiveUnits is '" + printable(*units) + "'" : "no emissiveUnits") +
                              ", read as W.m^-2.sr^-1.nm^-1");
    }

    info.wavelengths.nm = std::move(fromNames);
    if (const auto exact = exactWavelengths(header, info.wavelengths.nm)) {
        if (exact->empty())
            notes.warn(where, "spectrad:wavelengths does not belong to the channels; their names are read");
        else
            info.wavelengths.nm = *exact;
    }
    // Without our attribute the values are points, the layout's own reading of a band.
    const std::string* projection = findText(header, ours(exr::projection));
    info.projectionStated = projection != nullptr;
    info.wavelengths.projection =
        projection ? parseProjection(printable(*projection), where) : Projection::point;
    if (const std::string* text = findText(header, ours(exr::step))) {
        const auto step = parseDouble(*text);
        if (!step || *step <= 0)
            throw InputError(where, "spectrad:step is '" + printable(*text) + "' (allowed: nm, above 0)");
        info.wavelengths.step = *step;
    }

    for (auto it = header.begin(); it != header.end(); ++it) {
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute());
        std::string key = it.name();
        if (!text || key == exr::layoutVersion || key == exr::emissiveUnits || key == "name" ||
            key == "type" || std::any_of(emissiveKinds.begin(), emissiveKinds.end(), [&](auto& k) {
                return key == k.unitAttribute;
            }))
            continue;
        if (startsWith(key, exr::ourPrefix)) {
            key.erase(0, exr::ourPrefix.size());
            if (isOwnName(key)) continue;
        }
        info.attributes[key] = text->value();
    }
    return info;
}

}  // namespace spectrad
