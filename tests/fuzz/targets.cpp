#include "fuzz/targets.h"

#include "camera/film.h"
#include "image/bispectral.h"
#include "image/cube.h"
#include "image/picture_light.h"
#include "image/picture_values.h"
#include "scene/load.h"
#include "spectrum/detector_product.h"
#include "spectrum/readers/reader.h"
#include "spectrum/wavelengths.h"
#include "support/temporary_folder.h"

#include <cmath>
#include <cstdlib>

namespace spectrad::fuzz {

namespace {

const Library& library() {
    static const Library all(std::filesystem::path(SPECTRAD_SOURCE) / "spectra");
    return all;
}

const TemporaryFolder& folder() {
    static const TemporaryFolder own;
    return own;
}

[[noreturn]] void broken(const std::string& what) {
    std::fprintf(stderr, "promise broken: %s\n", what.c_str());
    std::abort();
}

/// An Error is an answer; it has one line. Anything else that is thrown is a bug.
template <typename Call>
void refused(Call&& call) {
    try {
        call();
    } catch (const Error& error) {
        if (*error.what() == '\0') broken("an error without a word");
    }
}

void requireFinite(const Curve& curve) {
    for (double value : curve.sampleValues())
        if (!std::isfinite(value)) broken("a value that is not finite");
    const auto [low, high] = curve.bounds();
    if (std::isnan(low) || std::isnan(high)) broken("bounds that are no numbers");
}

void scene(std::string_view bytes) {
    const auto path = folder().write("scene.xml", std::string(bytes));
    refused([&] {
        Notes notes;
        const LoadOptions options{{}, true};
        (void)loadScene(path, library(), options, notes);
    });
}

void table(std::string_view bytes) {
    for (const char* name : {"t.csv", "t.spd", "t.txt"}) {
        const auto path = folder().write(name, std::string(bytes));
        refused([&] {
            const SpectrumTable read = readTable(path);
            for (size_t i = 0; i < read.nm.size(); ++i)
                if (!std::isfinite(read.nm[i]) || (i > 0 && read.nm[i] <= read.nm[i - 1]))
                    broken("wavelengths that do not ascend");
            for (const auto& column : read.columns) {
                if (column.size() != read.nm.size()) broken("a column of another length");
                for (double value : column)
                    if (!std::isfinite(value)) broken("a value that is not finite");
            }
        });
    }
    Notes notes;
    const SpectrumResolver resolver(library(), folder().path(), true, notes);
    refused([&] { (void)parseFilm(bytes, "t.film", resolver); });
}

/// The first letter says what the rest is.
void words(std::string_view bytes) {
    if (bytes.empty()) return;
    const std::string text(bytes.substr(1));
    const SourceLocation where{"words"};
    Notes notes;
    const SpectrumResolver resolver(library(), folder().path(), true, notes);
    refused([&] {
        switch (bytes[0]) {
            case 'w': {
                const Wavelengths grid = parseWavelengths(text, where);
                if (grid.nm.empty() || grid.nm.size() > 10000) broken("a number of bands beyond the limit");
                break;
            }
            case 'd':
                (void)detectorSpectrum(text, resolver, where);
                break;
            case 's': {
                static const auto path = folder().write(
                    "set.xml",
                    R"(<scene version="1"><material name="m"><diffuse reflectance="constant:0.5"/></material>
  <node name="n"><sphere radius="1" material="m"/></node>
  <light name="lamp" type="point" position="0 0 3" spectrum="illuminants/D65" intensity="1 cd"/>
  <camera name="c" size="4x4"/></scene>)");
                const LoadOptions options{{text}, true};
                (void)loadScene(path, library(), options, notes);
                break;
            }
            default: {
                const Role role = static_cast<Role>(static_cast<unsigned char>(bytes[0]) % 8);
                for (const Curve& curve : resolver.resolve(text, role, where).curves)
                    requireFinite(curve);
            }
        }
    });
}

void requireSound(const Cube& cube) {
    for (float value : cube.values)
        if (!std::isfinite(value)) broken("a cube with a value that is not finite");
}

void exr(std::string_view bytes) {
    const auto path = folder().write("image.exr", std::string(bytes));
    Notes notes;
    refused([&] { (void)readCubeInfo(path, notes); });
    refused([&] { requireSound(readCube(path, notes)); });
    refused([&] { (void)readBispectral(path); });
}

/// Header and raster, parted by a line "---".
void envi(std::string_view bytes) {
    constexpr std::string_view parting = "\n---\n";
    const size_t at = bytes.find(parting);
    folder().write("image.hdr", std::string(bytes.substr(0, at)));
    const auto path = folder().write("image.img", at == std::string_view::npos
                                                      ? std::string()
                                                      : std::string(bytes.substr(at + parting.size())));
    Notes notes;
    refused([&] { (void)readCubeInfo(path, notes); });
    refused([&] { requireSound(readCube(path, notes)); });
}

/// What a file says of its colours is read as well, and of any value it makes a finite one.
void requireColours(const PictureValues& picture) {
    Notes notes;
    const PictureLight light(picture, "image", {}, notes);
    for (const double signal : {0.0, 0.3, 1.0})
        for (const double component : light.linearSrgb({signal, 1 - signal, 0.5}))
            if (!std::isfinite(component)) broken("a picture with a colour that is not finite");
}

void png(std::string_view bytes) {
    refused([&] { requireColours(decodeValues(bytes, "image.png")); });
}

void jpeg(std::string_view bytes) {
    refused([&] { requireColours(decodeJpeg(bytes, "image.jpg")); });
}

}  // namespace

const std::vector<Target>& targets() {
    static const std::vector<Target> all{{"scene", scene}, {"table", table}, {"words", words}, {"exr", exr},
                                         {"envi", envi},   {"png", png},     {"jpeg", jpeg}};
    return all;
}

}  // namespace spectrad::fuzz
