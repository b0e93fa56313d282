#include "cli/observation.h"

#include "base/text.h"

#include <CLI/CLI.hpp>

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

bool sameChromaticity(const Triple& a, const Triple& b) {
    constexpr double tolerance = 1e-4;
    const auto xyA = chromaticity(a), xyB = chromaticity(b);
    return xyA && xyB && std::hypot((*xyA)[0] - (*xyB)[0], (*xyA)[1] - (*xyB)[1]) < tolerance;
}

}  // namespace

void addObserverOptions(CLI::App& command, ObserverArguments& arguments) {
    command
        .add_option("--observer", arguments.observer,
                    "an observer or camera of the library, or a file of sensitivities over nm; default: "
                    "cie1931-2 (others: "
                    "cie1964-10, cie2015-2, cie2015-10, stockman-sharpe-2, stockman-sharpe-10, nikon-5100, "
                    "sigma-sd-merrill)")
        ->type_name("NAME|FILE");
    command
        .add_option("--white", arguments.white,
                    "the white: a light's spectrum (chromaticity only), X,Y,Z with Y in cd/m2, or at:X,Y for "
                    "a pixel; "
                    "default: the scene's first light as the cube states it, else E. A reflectance cube is "
                    "seen under that "
                    "light (default: D65)")
        ->type_name("LIGHT|XYZ|at:X,Y");
}

static bool needsLight(const CubeInfo& info) {
    return info.kind == CubeKind::reflectance || info.kind == CubeKind::transmittance;
}

Observation::Observation(const ObserverArguments& arguments, const CubeInfo& info, Notes& notes)
    : wanted_(arguments.white),
      info_(info),
      notes_(notes),
      library_(Library::open()),
      resolver_(library_, ".", false, notes),
      standard_(standardObserver(library_)),
      detector_(detectorFor(arguments.observer, resolver_, {})) {
    if (!detector_.tristimulus) toXyz_ = towardsXyz(detector_, standard_);
    if (!needsLight(info)) {
        weights_ = weightsOn(info.wavelengths, detector_);
        return;
    }
    const bool named = !wanted_.empty() && !isPlace(wanted_) && !isNumbers(wanted_);
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

ChannelImage Observation::xyz(ChannelImage channels) const {
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

White Observation::white(const ChannelImage& image) const {
    if (isPlace(wanted_)) {
        const std::vector<std::string_view> place = split(std::string_view(wanted_).substr(3), ',');
        const auto x = parseInteger(place[0]), y = place.size() == 2 ? parseInteger(place[1]) : std::nullopt;
        if (!x || !y) throw UsageError("--white: '" + wanted_ + "' is not at:X,Y in pixels, (0,0) top left");
        constexpr long long beyond = 1 << 30;  // outside every image, and inside int
        return whiteAt(image, static_cast<int>(std::clamp(*x, -1LL, beyond)),
                       static_cast<int>(std::clamp(*y, -1LL, beyond)));
    }
    if (wanted_.empty() && !light_) return statedWhite();
    White white =
        whiteFor(light_ && !isNumbers(wanted_) ? light_->text : wanted_, detector_, toXyz_, resolver_, {});
    return light_ ? withLuminance(white, diffuserY) : white;
}

double brightest(const ChannelImage& xyz) {
    return *std::max_element(xyz.plane[1].begin(), xyz.plane[1].end());
}

}  // namespace spectrad
