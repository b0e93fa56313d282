#include "cli/observation.h"

#include "base/text.h"
#include "colour/develop.h"
#include "scene/load.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace spectrad {

namespace {

constexpr const char* equalEnergy = "constant:1";
constexpr const char* daylight = "illuminants/D65";
constexpr double diffuserY = 100;

bool isPlace(const std::string& white) {
    return startsWith(white, "at:");
}

bool isNumbers(const std::string& white) {
    const std::vector<std::string_view> parts = split(white, ',');
    return std::all_of(parts.begin(), parts.end(),
                       [](std::string_view part) { return parseDouble(part).has_value(); });
}

/// The detector with every response multiplied by the light's spectrum.
Detector lit(Detector detector, const Curve& light, double scale) {
    for (Curve& response : detector.response)
        response = Curve::combined({response, light}, [](std::span<const double> v) { return v[0] * v[1]; });
    detector.scale *= scale;
    return detector;
}

std::optional<Triple> parseTriple(const std::string& text) {
    const std::vector<std::string_view> parts = split(text, ',');
    if (parts.size() != 3) return std::nullopt;
    Triple triple{};
    for (size_t i = 0; i < 3; ++i) {
        const std::optional<double> value = parseDouble(parts[i]);
        if (!value || *value < 0) return std::nullopt;
        triple[i] = *value;
    }
    return triple[1] > 0 ? std::optional(triple) : std::nullopt;
}

constexpr const char* ofImage = "image";

/// The mean of all pixels, as if the world were grey.
White meanOf(const ChannelImage& image) {
    Triple mean{};
    for (size_t k = 0; k < 3; ++k)
        for (const double value : image.plane[k])
            mean[k] += value / static_cast<double>(image.pixels());
    if (!(mean[1] > 0)) throw InputError("the white 'image' is the mean of a black image");
    return {ofImage, {mean[0] / mean[1], 1, mean[2] / mean[1]}, false};
}

/// The pixel that "at:X,Y" names.
White placed(const std::string& wanted, const ChannelImage& image) {
    const std::vector<std::string_view> place = split(std::string_view(wanted).substr(3), ',');
    const auto x = parseInteger(place[0]), y = place.size() == 2 ? parseInteger(place[1]) : std::nullopt;
    if (!x || !y) throw UsageError("--white: '" + wanted + "' is not at:X,Y in pixels, (0,0) top left");
    constexpr long long beyond = 1 << 30;  // outside every image, and inside int
    return whiteAt(image, static_cast<int>(std::clamp(*x, -1LL, beyond)),
                   static_cast<int>(std::clamp(*y, -1LL, beyond)));
}

bool sameChromaticity(const Triple& a, const Triple& b) {
    constexpr double tolerance = 1e-4;
    const auto xyA = chromaticity(a), xyB = chromaticity(b);
    return xyA && xyB && std::hypot((*xyA)[0] - (*xyB)[0], (*xyA)[1] - (*xyB)[1]) < tolerance;
}

}  // namespace

void addObserverOptions(CLI::App& command, ObserverArguments& arguments) {
    command
        .add_option(
            "--observer", arguments.observer,
            "who looks: an observer or camera of the library, a file of sensitivities over nm, a film "
            "(generic-reversal, or x.film), a detector of a scene (SCENE.xml#NAME), or a product "
            "'qe:sensors/ccd * filters/ir-cut * (R = filters/red, G = filters/green)'; default: cie1931-2 "
            "(others: cie1964-10, cie2015-2, cie2015-10, stockman-sharpe-2, stockman-sharpe-10, "
            "cie1951-scotopic, protanope, deuteranope, tritanope, protanomalous-10, deuteranomalous-10, "
            "nikon-5100, sigma-sd-merrill, dcs200-like)")
        ->type_name("NAME|FILE");
    command
        .add_option("--white", arguments.white,
                    "the white: a light's spectrum (chromaticity only), X,Y,Z with Y in cd/m2, at:X,Y for "
                    "a pixel, or image for the mean of all; "
                    "default: the scene's first light as the cube states it, else E. A reflectance cube is "
                    "seen under that "
                    "light (default: D65)")
        ->type_name("LIGHT|XYZ|at:X,Y|image");
}

bool namesFilm(const std::string& observer) {
    return isFilm(observer, Library::open());
}

/// SCENE.xml#NAME is a <detector> of that scene, a film its layers; the rest is a spectrum.
Detector Observation::wantedDetector(const ObserverArguments& arguments) {
    if (arguments.detector) return *arguments.detector;
    const std::string& observer = arguments.observer;
    if (isFilm(observer, library_)) {
        film_.emplace(filmFor(observer, resolver_, library_), standard_);
        return film_->film().layers;
    }
    const size_t hash = observer.find(".xml#");
    if (hash == std::string::npos) return detectorFor(observer, resolver_, {});
    const std::string file = resolver_.findFile(observer.substr(0, hash + 4), {}).string(),
                      name = observer.substr(hash + 5);
    Notes unsaid;  // that a scene has no light is no concern of its detectors
    const Scene scene = loadScene(file, library_, {}, unsaid);
    std::vector<std::string> known;
    for (const DetectorUse& use : scene.detectors) {
        if (use.name == name) {
            Detector detector = detectorFrom(use.sensitivity);
            detector.name = observer;
            return detector;
        }
        known.push_back(use.name);
    }
    throw InputError(SourceLocation{file},
                     fmt::format("has no <detector name=\"{}\">{} (there are: {})", name,
                                 didYouMean(name, known), fmt::join(known, ", ")));
}

static bool needsLight(const CubeInfo& info) {
    return info.kind == CubeKind::reflectance || info.kind == CubeKind::transmittance;
}

Observation::Observation(const ObserverArguments& arguments, const CubeInfo& info, Notes& notes)
    : wanted_(arguments.white),
      info_(info),
      notes_(notes),
      library_(Library::open()),
      resolver_(library_, arguments.folder, arguments.restricted, notes),
      standard_(standardObserver(library_)),
      filmStops_(arguments.filmStops),
      detector_(wantedDetector(arguments)) {
    if (!detector_.tristimulus) toXyz_ = towardsXyz(detector_, standard_);
    if (!needsLight(info)) {
        weights_ = weightsOn(info.wavelengths, detector_);
        return;
    }
    const bool named = !wanted_.empty() && wanted_ != ofImage && !isPlace(wanted_) && !isNumbers(wanted_);
    light_ = resolver_.resolve(named ? wanted_ : daylight, Role::light, {});
    const std::array<const Curve*, 1> alone{&light_->curve()};
    const double y = respond(detector_.tristimulus ? detector_ : standard_, alone)[1];
    if (!(y > 0))
        throw InputError("'" + light_->text +
                         "' cannot light a reflectance cube: the observer sees no light of it");
    lightScale_ = diffuserY / y;
    weights_ = weightsOn(info.wavelengths, lit(detector_, light_->curve(), lightScale_));
}

ChannelImage Observation::channels(const Cube& cube) const {
    ChannelImage image(cube.info.width, cube.info.height, detector_.size());
    for (int y = 0; y < cube.info.height; ++y)
        observeRow(weights_, cube.row(y, 0), y, image);
    return image;
}

std::vector<double> Observation::channels(const std::vector<double>& bands) const {
    std::vector<double> out;
    for (const std::vector<double>& weights : weights_.weights) {
        double sum = 0;
        for (size_t band = 0; band < bands.size(); ++band)
            sum += weights[band] * bands[band];
        out.push_back(sum);
    }
    return out;
}

double Observation::metered(const ChannelImage& channels) const {
    if (!film_) return 1;
    if (isPlace(wanted_)) return film_->metered(placed(wanted_, channels).xyz[1]);
    const std::optional<Triple> stated = parseTriple(wanted_);
    if (stated) return (*stated)[1];
    std::vector<double> green = channels.plane[1];
    const double light = green.empty() ? 0 : film_->metered(quantile(green, 0.99));
    return light > 0 ? light : 1;
}

Triple Observation::xyz(const std::vector<double>& channels, double metered) const {
    if (detector_.tristimulus) return {channels[0], channels[1], channels[2]};
    if (!film_) return toXyz(toXyz_, channels);
    const Triple exposures = film_->exposures(channels, metered, filmStops_);
    return diagonal({diffuserY, diffuserY, diffuserY}) * film_->xyz(film_->densities(exposures));
}

ChannelImage Observation::xyz(ChannelImage channels) const {
    if (film_) {
        const double white = metered(channels);
        for (size_t i = 0; i < channels.pixels(); ++i) {
            const Triple seen = xyz(
                std::vector<double>{channels.plane[0][i], channels.plane[1][i], channels.plane[2][i]}, white);
            for (size_t k = 0; k < 3; ++k)
                channels.plane[k][i] = seen[k];
        }
        return channels;
    }
    return detector_.tristimulus ? std::move(channels) : toXyz(toXyz_, channels);
}

White Observation::statedWhite() const {
    const auto xyz = info_.attributes.find(attribute::whiteXyz),
               name = info_.attributes.find(attribute::white);
    const std::optional<Triple> stated =
        xyz == info_.attributes.end() ? std::nullopt : parseTriple(xyz->second);
    if (!stated) {
        White white = whiteFor(equalEnergy, detector_, toXyz_, resolver_, {});
        white.name = "E";
        return white;
    }
    White known{name == info_.attributes.end() ? xyz->second : name->second, *stated, false};
    if (detector_.name.ends_with("cie1931-2")) return known;
    // Another observer wants the light's spectrum. A name that is the library's says it; one of the scene's
    // own may by chance name another light here, which its chromaticity betrays.
    try {
        if (sameChromaticity(whiteFor(known.name, standard_, {}, resolver_, {}).xyz, known.xyz))
            return whiteFor(known.name, detector_, toXyz_, resolver_, {});
    } catch (const InputError&) {
        // Not in the library: the chromaticity must do.
    }
    notes_.warn("the spectrum of the white '" + known.name +
                "' is not known here: its CIE 1931 chromaticity is used (--white)");
    return known;
}

/// Who looks at a projection is adapted to its lamp, and takes the clearest film for white.
White Observation::projectionWhite() const {
    const CharacteristicCurve* curves = film_->film().curves.data();
    const double clear = film_->xyz({curves[0].dmin, curves[1].dmin, curves[2].dmin})[1];
    return withLuminance({film_->film().projectorName, film_->lamp(), false}, diffuserY * clear);
}

White Observation::whiteUnder(const std::string& name, const Curve& light) const {
    return film_ ? projectionWhite() : whiteOf(name, light, detector_, toXyz_, {});
}

White Observation::white(const ChannelImage& image) const {
    if (film_) return projectionWhite();
    if (isPlace(wanted_)) return placed(wanted_, image);
    if (wanted_ == ofImage) return meanOf(image);
    if (wanted_.empty() && !light_) return statedWhite();
    White white =
        whiteFor(light_ && !isNumbers(wanted_) ? light_->text : wanted_, detector_, toXyz_, resolver_, {});
    return light_ ? withLuminance(white, diffuserY) : white;
}

double brightest(const ChannelImage& xyz) {
    return *std::max_element(xyz.plane[1].begin(), xyz.plane[1].end());
}

}  // namespace spectrad
