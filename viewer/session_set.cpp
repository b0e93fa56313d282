// What can be changed by word: "lamp.spectrum=illuminants/A", "exposure=auto".
#include "base/text.h"
#include "colour/image_white.h"
#include "viewer/observers.h"
#include "viewer/session.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

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

}  // namespace

void Session::setLightSpectrum(size_t light, const std::string& spectrum) {
    Spectrum resolved = resolver_.resolve(spectrum, Role::light, {});
    Look changed = look(edited);
    changed.lights.at(light).emitter.spectrum = std::move(resolved);
    changed.lights[light].emitter.texture.reset();
    touch(changed);
    // What cannot shine, such as an amount of a spectrum without light, is found out before it is kept.
    check(changed);
    look(edited) = std::move(changed);
    watched_.watch(files());
}

void Session::setReflectance(Index material, const std::string& spectrum) {
    Look changed = look(edited);
    changed.reflectances[material] = resolver_.resolve(spectrum, Role::reflectance, {});
    touch(changed);
    check(changed);
    look(edited) = std::move(changed);
    watched_.watch(files());
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
    const std::vector<Material> none;
    const std::vector<Material>& materials = aboutScene() ? aboutScene()->scene().materials : none;
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
    throw UsageError(fmt::format("{} has no light{} '{}'{}", aboutScene() ? "the scene" : "the cube",
                                 aboutScene() ? " or material" : "", name, didYouMean(name, names)));
}

void Session::setWhite(const std::string& text) {
    const std::string before = std::exchange(white, text);
    try {
        // A white with a luminance says how bright the picture is shown; a scene's own lights have none.
        const Eye& eye = *look(edited).eye;
        if (isOfImage(text) && waits) (void)whiteOf(look(edited));
        if (isOfImage(text) ? isPlace(text)
            : text.empty()  ? !aboutScene()
                            : whiteFor(text, eye.detector, eye.matrix, resolver_, {}).hasLuminance) {
            heldLuminance.reset();
            automatic = false;
        }
    } catch (...) {
        white = before;
        throw;
    }
}

void Session::setDisplay(const std::string& text) {
    if (text.starts_with("displays/") || text.ends_with(".csv")) {
        const auto made =
            std::make_shared<const SpectralDisplay>(spectralDisplay(resolver_.resolve(text, Role::any, {})));
        (void)made->seenBy(standard_);
        primaries = made;
    } else {
        codes = spectrad::displayFor(text);
        primaries.reset();
    }
    display = text;
}

void Session::setPicture(const std::string& name, const std::string& value) {
    if (!aboutCube())
        throw UsageError(name + ": a scene's picture is what the observer sees; bands are a cube's");
    const std::vector<double>& nm = about().wavelengths().nm;
    const auto nearestBand = [&](std::string_view text) {
        const double wanted = numberIn(name, std::string(text), nm.front(), nm.back());
        return static_cast<size_t>(std::min_element(nm.begin(), nm.end(),
                                                    [&](double a, double b) {
                                                        return std::abs(a - wanted) < std::abs(b - wanted);
                                                    }) -
                                   nm.begin());
    };
    if (name == "picture") {
        picture = oneOf<Picture>(name, value,
                                 {{"observer", Picture::observer},
                                  {"band", Picture::band},
                                  {"false-colour", Picture::falseColour}});
    } else if (name == "band") {
        bands.bands[0] = nearestBand(value);
        picture = Picture::band;
    } else {
        const std::vector<std::string_view> three = split(value, ',');
        if (three.size() != 3)
            throw UsageError("bands: '" + value + "' is not three wavelengths, for red, green and blue");
        bands.bands = {nearestBand(three[0]), nearestBand(three[1]), nearestBand(three[2])};
        picture = Picture::falseColour;
    }
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
             Look changed = look(edited);
             setObserver(changed, value, resolver_, library_);
             touch(changed);
             check(changed);
             // A film's picture is as bright as its projector.
             if (!changed.film != !look(edited).film) heldLuminance.reset();
             look(edited) = std::move(changed);
         }},
        {"adapt", [&] { adaptation = parseAdaptation(value); }},
        {"white", [&] { setWhite(value); }},
        {"exposure",
         [&] {
             if (value == "auto") {
                 heldLuminance.reset();
                 automatic = true;
                 ev = 0;
             } else {
                 ev = numberIn("exposure", value, -mostStops, mostStops);
             }
         }},
        {"display", [&] { setDisplay(value); }},
        {"tone", [&] { tone = parseTone(value); }},
        {"degree", [&] { degree = numberIn("degree", value, 0, 1); }},
        {"mapping", [&] { mapping = parseGamutMapping(value); }},
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
             if (!aboutScene()) throw UsageError("samples: a cube has its samples already");
             stand.samples = static_cast<int>(numberIn("samples", value, 1, 64));
         }},
    };
    std::vector<std::string> names{"picture", "band", "bands"};
    if (std::find(names.begin(), names.end(), what) != names.end()) return setPicture(what, value);
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

}  // namespace spectrad::view
