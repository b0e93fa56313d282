#include "cli/observation.h"

#include "base/text.h"
#include "camera/film_picture.h"
#include "colour/develop.h"
#include "colour/image_white.h"
#include "render/scene_detector.h"
#include "spectrum/projection.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace spectrad {

namespace {

constexpr const char* daylight = "illuminants/D65";

bool isNumbers(const std::string& white) {
    const std::vector<std::string_view> parts = split(white, ',');
    return std::all_of(parts.begin(), parts.end(),
                       [](std::string_view part) { return parseDouble(part).has_value(); });
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
        .add_option("--projector", arguments.projector,
                    "a film's: the lamp that its transparency is looked at with; default: the film's own")
        ->type_name("LIGHT");
    command
        .add_option("--viewer", arguments.viewer,
                    "a film's: the observer who looks at its projection; default: cie1931-2")
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

/// What a detector would see beyond the bands is missing from its channels: in words where it is much.
static std::string seenOutside(const Detector& detector, const Wavelengths& grid) {
    constexpr double much = 0.01;
    double most = much;
    size_t worst = detector.size();
    for (size_t c = 0; c < detector.size(); ++c) {
        const std::array<const Curve*, 1> alone{&detector.response[c]};
        const double all = integrate(alone);
        const double share = all > 0 ? 1 - integrate(alone, grid.nm.front(), grid.nm.back()) / all : 0;
        if (share > most) most = share, worst = c;
    }
    if (worst == detector.size()) return {};
    return fmt::format(
        "{} % of what '{}' of {} sees lies outside the cube's {} to {} nm, where it has no light",
        rounded(100 * most, 3), detector.channels[worst], detector.name, shortest(grid.nm.front()),
        shortest(grid.nm.back()));
}

bool namesLight(const std::string& white) {
    return !white.empty() && !isOfImage(white) && !isNumbers(white);
}

bool namesFilm(const std::string& observer) {
    return isFilm(observer, Library::open());
}

/// SCENE.xml#NAME is a <detector> of that scene, a film its layers; the rest is a spectrum.
Detector Observation::wantedDetector(const ObserverArguments& arguments) {
    if (arguments.detector) return *arguments.detector;
    const std::string& observer = arguments.observer;
    if ((!arguments.projector.empty() || !arguments.viewer.empty()) && !isFilm(observer, library_))
        throw UsageError(fmt::format("{}: '{}' is no film",
                                     arguments.projector.empty() ? "--viewer" : "--projector", observer));
    if (isFilm(observer, library_)) {
        film_.emplace(filmFor(observer, resolver_, library_), standard_);
        if (!arguments.projector.empty() || !arguments.viewer.empty()) {
            std::optional<Spectrum> lamp;
            std::optional<Detector> eye;
            if (!arguments.projector.empty()) lamp = resolver_.resolve(arguments.projector, Role::light, {});
            if (!arguments.viewer.empty()) eye = detectorFor(arguments.viewer, resolver_, {});
            film_->project(lamp ? &*lamp : nullptr, eye ? &*eye : nullptr, standard_);
        }
        return film_->film().layers;
    }
    if (std::optional<Detector> detector = sceneDetector(observer, resolver_, library_)) return *detector;
    return detectorOrFilmMeant(observer, resolver_, library_);
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
    if (needsLight(info.kind))
        light_ = resolver_.resolve(namesLight(wanted_) ? wanted_ : daylight, Role::light, {});
    const Detector seeing = light_ ? litBy(*light_, detector_, standard_) : detector_;
    weights_ = weightsOn(info.wavelengths, seeing);
    outside_ = seenOutside(seeing, info.wavelengths);
}

ChannelImage Observation::channels(const Cube& cube) const {
    if (!outside_.empty()) notes_.say(outside_);
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
    return film_ ? meteredBy(*film_, channels, wanted_) : 1;
}

Triple Observation::xyz(const std::vector<double>& channels, double metered) const {
    if (detector_.tristimulus) return {channels[0], channels[1], channels[2]};
    return film_ ? projected(*film_, channels, metered, filmStops_) : toXyz(toXyz_, channels);
}

ChannelImage Observation::xyz(ChannelImage channels) const {
    if (film_) {
        const double white = metered(channels);
        return projected(*film_, std::move(channels), white, filmStops_);
    }
    return detector_.tristimulus ? std::move(channels) : toXyz(toXyz_, channels);
}

White Observation::whiteUnder(const std::string& name, const Curve& light) const {
    return film_ ? projectionWhite(*film_) : whiteOf(name, light, detector_, toXyz_, {});
}

White Observation::white(const ChannelImage& image) const {
    if (film_) return projectionWhite(*film_);
    if (isOfImage(wanted_)) return whiteOfImage(wanted_, image);
    if (wanted_.empty() && !light_)
        return statedWhite(info_, detector_, toXyz_, standard_, resolver_, notes_);
    White white =
        whiteFor(light_ && !isNumbers(wanted_) ? light_->text : wanted_, detector_, toXyz_, resolver_, {});
    return light_ ? withLuminance(white, diffuserY) : white;
}

double brightest(const ChannelImage& xyz) {
    return *std::max_element(xyz.plane[1].begin(), xyz.plane[1].end());
}

}  // namespace spectrad
