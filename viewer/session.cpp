#include "viewer/session.h"

#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace spectrad::view {

namespace {

double numberIn(const std::string& name, const std::string& value, double least, double most) {
    const std::optional<double> number = parseDouble(value);
    if (!number || !(*number >= least && *number <= most))
        throw UsageError(fmt::format("{}: '{}' is not a number from {} to {}", name, value, shortest(least),
                                     shortest(most)));
    return *number;
}

bool flagIn(const std::string& name, const std::string& value) {
    if (value == "true" || value == "on") return true;
    if (value == "false" || value == "off") return false;
    throw UsageError(name + ": '" + value + "' is neither on nor off");
}

template <typename Value>
Value oneOf(const std::string& name, const std::string& value,
            const std::vector<std::pair<std::string, Value>>& choices) {
    std::vector<std::string> names;
    for (const auto& [text, choice] : choices) {
        if (text == value) return choice;
        names.push_back(text);
    }
    throw UsageError(fmt::format("{}: '{}' is not known (allowed: {}){}", name, value, fmt::join(names, ", "),
                                 didYouMean(value, names)));
}

constexpr double mostStops = 1000;

}  // namespace

Session::Session(std::unique_ptr<SceneSubject> scene, const Library& library, Notes& notes)
    : scene_(std::move(scene)),
      library_(library),
      resolver_(library_, std::filesystem::path(scene_->scene().file).parent_path(), false, notes),
      standard_(standardObserver(library_)),
      looks_{scene_->firstLook(), scene_->firstLook()} {
    for (Look& look : looks_)
        touch(look);
}

void Session::setLightSpectrum(size_t light, const std::string& spectrum) {
    Spectrum resolved = resolver_.resolve(spectrum, Role::light, {});
    Look changed = look(edited);
    changed.lights.at(light).emitter.spectrum = std::move(resolved);
    touch(changed);
    // What cannot shine, such as an amount of a spectrum without light, is found out before it is kept.
    (void)subject().whiteAmount(changed);
    look(edited) = std::move(changed);
}

void Session::setReflectance(Index material, const std::string& spectrum) {
    Look changed = look(edited);
    changed.reflectances[material] = resolver_.resolve(spectrum, Role::reflectance, {});
    touch(changed);
    (void)subject().whiteAmount(changed);
    look(edited) = std::move(changed);
}

void Session::setOfLook(Look& look, const std::string& name, const std::string& attribute,
                        const std::string& value) {
    std::vector<std::string> names;
    for (size_t i = 0; i < look.lights.size(); ++i) {
        LightSetting& light = look.lights[i];
        names.push_back(light.name);
        if (light.name != name) continue;
        if (attribute == "spectrum")
            setLightSpectrum(i, value);
        else if (attribute == "times")
            light.times = numberIn(name + ".times", value, 0, 1e9);
        else if (attribute == "on")
            light.on = flagIn(name + ".on", value);
        else
            throw UsageError("a light has no '" + attribute + "' here (allowed: spectrum, times, on)");
        return;
    }
    const std::vector<Material>& materials = scene_->scene().materials;
    for (Index m = 0; m < materials.size(); ++m) {
        names.push_back(materials[m].name);
        if (materials[m].name != name || name.empty()) continue;
        if (attribute != "reflectance")
            throw UsageError("a material has no '" + attribute + "' here (allowed: reflectance)");
        if (!materials[m].diffuse || !materials[m].diffuse->reflectance)
            throw UsageError("material '" + name + "' has no <diffuse> with a reflectance");
        setReflectance(m, value);
        return;
    }
    throw UsageError("the scene has no light or material '" + name + "'" + didYouMean(name, names));
}

void Session::set(const std::string& assignment) {
    const size_t equals = assignment.find('=');
    if (equals == std::string::npos)
        throw UsageError("'" + assignment + "' is not NAME.ATTRIBUTE=VALUE or SETTING=VALUE");
    const std::string what = assignment.substr(0, equals), value = assignment.substr(equals + 1);
    if (const size_t dot = what.rfind('.'); dot != std::string::npos) {
        setOfLook(look(edited), what.substr(0, dot), what.substr(dot + 1), value);
        touch(look(edited));
        return;
    }
    const std::vector<std::pair<std::string, std::function<void()>>> settings{
        {"observer",
         [&] {
             const Detector detector = detectorFor(value, resolver_, {});
             look(edited).eye = std::make_shared<const Eye>(Eye{detector, towardsXyz(detector, standard_)});
             touch(look(edited));
         }},
        {"adapt", [&] { adaptation = parseAdaptation(value); }},
        {"white",
         [&] {
             const std::string before = std::exchange(white, value);
             try {
                 (void)whiteOf(look(edited));
             } catch (...) {
                 white = before;
                 throw;
             }
         }},
        {"exposure",
         [&] {
             if (value == "auto")
                 heldLuminance.reset(), ev = 0;
             else
                 ev = numberIn("exposure", value, -mostStops, mostStops);
         }},
        {"display", [&] { display = displayFor(value); }},
        {"mode",
         [&] {
             mode = oneOf<Mode>("mode", value,
                                {{"single", Mode::single},
                                 {"split", Mode::split},
                                 {"difference", Mode::difference},
                                 {"mixture", Mode::mixture}});
         }},
        {"divider", [&] { divider = numberIn("divider", value, 0, 1); }},
        {"mix", [&] { mix = numberIn("mix", value, 0, 1); }},
        {"look",
         [&] {
             edited = oneOf<int>("look", value, {{"A", 0}, {"B", 1}});
         }},
        {"gamut", [&] { gamutWarning = flagIn("gamut", value); }},
        {"samples",
         [&] {
             scene_->setSamples(static_cast<int>(numberIn("samples", value, 1, 64)));
             invalidate();
         }},
    };
    std::vector<std::string> names;
    for (const auto& [name, apply] : settings) {
        if (name == what) {
            apply();
            return;
        }
        names.push_back(name);
    }
    throw UsageError(fmt::format("there is no setting '{}' (allowed: {}, NAME.ATTRIBUTE){}", what,
                                 fmt::join(names, ", "), didYouMean(what, names)));
}

White Session::whiteOf(const Look& look) {
    if (white.empty()) return subject().white(look);
    return whiteFor(white, look.eye->detector, look.eye->matrix, resolver_, {});
}

DevelopSettings Session::settings(const Look& look) {
    DevelopSettings made;
    made.adaptation = adaptation;
    made.white = whiteOf(look);
    made.exposure.ev = ev;
    made.display = display;
    return made;
}

void Session::autoExpose() {
    DevelopSettings made = settings(looks_[0]);
    made.exposure.ev = 0;
    heldLuminance = displayWhiteLuminance(subject().xyz(looks_[0]), made);
}

Shown Session::shown(const Look& look) {
    if (!heldLuminance) autoExpose();
    return {developMatrix(settings(look), *heldLuminance * std::exp2(-ev)), display};
}

/// A mixture's white is the mixture of the whites, each as strong as its light.
Shown Session::mixedShown() {
    if (!heldLuminance) autoExpose();
    DevelopSettings made = settings(looks_[0]);
    if (white.empty()) {
        const double a = (1 - mix) * subject().whiteAmount(looks_[0]),
                     b = mix * subject().whiteAmount(looks_[1]);
        const Triple whiteA = subject().white(looks_[0]).xyz, whiteB = subject().white(looks_[1]).xyz;
        if (a + b > 0)
            for (size_t c = 0; c < 3; ++c)
                made.white.xyz[c] = (a * whiteA[c] + b * whiteB[c]) / (a + b);
    }
    return {developMatrix(made, *heldLuminance * std::exp2(-ev)), display};
}

bool Session::refresh(std::vector<std::uint32_t>& left, std::vector<std::uint32_t>& right) {
    if (!heldLuminance) autoExpose();
    const bool two = mode != Mode::single;
    const std::string state = fmt::format(
        "{} {} {} {} {} {} {} {} {} {} {}", changes_, static_cast<int>(mode), looks_[0].version,
        two ? looks_[1].version : 0, static_cast<int>(adaptation), white, display.name, *heldLuminance, ev,
        mode == Mode::mixture ? mix : 0, mode == Mode::difference ? differenceTop : 0);
    if (state == shownState_) return false;
    right.clear();
    difference.reset();
    switch (mode) {
        case Mode::single:
            subject().show(looks_[0], shown(looks_[0]), left);
            break;
        case Mode::split:
            subject().show(looks_[0], shown(looks_[0]), left);
            subject().show(looks_[1], shown(looks_[1]), right);
            break;
        case Mode::mixture:
            subject().showMixed(looks_[0], looks_[1], mix, mixedShown(), left);
            break;
        case Mode::difference: {
            const White seenAgainst = withLuminance(whiteOf(looks_[0]), *heldLuminance);
            difference =
                colourDifference(subject().xyz(looks_[0]), subject().xyz(looks_[1]), seenAgainst.xyz);
            const std::vector<std::uint8_t> rgb = falseColours(difference->map, differenceTop);
            left.resize(difference->map.size());
            for (size_t i = 0; i < left.size(); ++i)
                left[i] = 0xff000000u | std::uint32_t{rgb[3 * i + 2]} << 16 |
                          std::uint32_t{rgb[3 * i + 1]} << 8 | rgb[3 * i];
            difference->map.clear();
            break;
        }
    }
    shownState_ = state;
    return true;
}

Pin Session::measured(int x, int y, const Look& look) {
    Pin pin{x, y, subject().spectrumAt(x, y, look), {}};
    if (pin.spectrum.empty()) return pin;
    const DetectorWeights weights = weightsOn(subject().wavelengths(), look.eye->detector);
    std::vector<double> channels;
    for (const std::vector<double>& weight : weights.weights) {
        double sum = 0;
        for (size_t band = 0; band < pin.spectrum.size(); ++band)
            sum += weight[band] * pin.spectrum[band];
        channels.push_back(sum);
    }
    pin.xyz = toXyz(look.eye->matrix, channels);
    return pin;
}

std::string Session::pinsAsCsv() const {
    std::string text = fmt::format("# unit: {}\n", scene_->unit());
    for (const Pin& pin : pins)
        text += fmt::format("# at {},{}: XYZ {} {} {}\n", pin.x, pin.y, rounded(pin.xyz[0], 6),
                            rounded(pin.xyz[1], 6), rounded(pin.xyz[2], 6));
    text += "wavelength_nm";
    for (const Pin& pin : pins)
        text += fmt::format(",radiance_W_m2_sr_nm at {} {}", pin.x, pin.y);
    text += '\n';
    const std::vector<double>& nm = scene_->wavelengths().nm;
    constexpr int floatDigits = 9;  // enough to read the same float back
    for (size_t band = 0; band < nm.size(); ++band) {
        text += shortest(nm[band]);
        for (const Pin& pin : pins)
            text +=
                "," + (band < pin.spectrum.size() ? rounded(pin.spectrum[band], floatDigits) : std::string());
        text += '\n';
    }
    return text;
}

}  // namespace spectrad::view
