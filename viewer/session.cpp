#include "viewer/session.h"

#include "base/text.h"
#include "viewer/save.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace spectrad::view {

namespace {

bool sameAmount(const Emitter& a, const Emitter& b) {
    const auto value = [](const Emitter& e) { return e.amount ? e.amount->value : e.scale; };
    return a.amount.has_value() == b.amount.has_value() &&
           (!a.amount || (a.amount->unit == b.amount->unit && a.amount->over == b.amount->over)) &&
           value(a) == value(b);
}

bool samePlace(const Pose& a, const Pose& b) {
    const auto near = [](Vec3 p, Vec3 q) { return p.x == q.x && p.y == q.y && p.z == q.z; };
    const Vec3 aheadA = normalized(a.target - a.eye), aheadB = normalized(b.target - b.eye);
    constexpr double tolerance = 1e-9;  // the target's distance depends on the geometry
    return near(a.eye, b.eye) && near(a.up, b.up) && length(aheadA - aheadB) < tolerance &&
           a.pixelsPerSlopeOverHeight == b.pixelsPerSlopeOverHeight && a.orthographic == b.orthographic;
}

const Spectrum* reflectanceOf(const Material& material) {
    return material.diffuse && material.diffuse->reflectance ? &*material.diffuse->reflectance : nullptr;
}

}  // namespace

Session::Session(Opener open, const Library& library, Notes& notes, bool restricted)
    : open_(std::move(open)),
      subject_(open_()),
      library_(library),
      notes_(notes),
      resolver_(library_, subject_->file().parent_path(), restricted, notes_),
      standard_(standardObserver(library_)),
      looks_{subject_->firstLook(), subject_->firstLook()} {
    for (Look& look : looks_)
        touch(look);
    watched_.watch(files());
    const size_t last = subject_->wavelengths().size() - 1;
    bands.bands = {last * 3 / 4, last / 2, last / 4};
}

Look Session::carried(const Look& old, const Subject& fresh) const {
    Look made = fresh.firstLook();
    const Look before = subject_->firstLook();
    made.eye = old.eye;
    for (LightSetting& light : made.lights)
        for (size_t i = 0; i < before.lights.size(); ++i) {
            const LightSetting &was = before.lights[i], &now = old.lights[i];
            if (was.name != light.name) continue;
            const bool sameSpectrum = was.emitter.spectrum.text == light.emitter.spectrum.text;
            if (sameAmount(was.emitter, light.emitter)) {
                light.times = now.times;
                light.on = now.on;
            }
            if (sameSpectrum && now.emitter.spectrum.text != was.emitter.spectrum.text)
                light.emitter.spectrum = resolver_.resolve(now.emitter.spectrum.text, Role::light, {});
        }
    const auto* scene = dynamic_cast<const SceneSubject*>(&fresh);
    if (!scene || !this->scene()) return made;
    const std::vector<Material>&then = this->scene()->scene().materials, &now = scene->scene().materials;
    for (const auto& [number, reflectance] : old.reflectances)
        for (Index m = 0; m < now.size(); ++m) {
            const Spectrum *was = reflectanceOf(then[number]), *is = reflectanceOf(now[m]);
            if (now[m].name == then[number].name && was && is && was->text == is->text)
                made.reflectances[m] = resolver_.resolve(reflectance.text, Role::reflectance, {});
        }
    return made;
}

std::vector<std::filesystem::path> Session::files() const {
    std::vector<std::filesystem::path> all = subject_->files();
    for (const Look& look : looks_) {
        for (const LightSetting& light : look.lights)
            all.insert(all.end(), light.emitter.spectrum.files.begin(), light.emitter.spectrum.files.end());
        for (const auto& [material, reflectance] : look.reflectances)
            all.insert(all.end(), reflectance.files.begin(), reflectance.files.end());
    }
    return all;
}

bool Session::reload() {
    if (!watched_.changed()) return false;
    try {
        std::unique_ptr<Subject> fresh = open_();
        std::array<Look, 2> looks{carried(looks_[0], *fresh), carried(looks_[1], *fresh)};
        auto* opened = dynamic_cast<SceneSubject*>(fresh.get());
        if (opened && scene()) {
            if (samePlace(opened->home(), scene()->home())) opened->setPose(scene()->pose());
            opened->setSize(scene()->width(), scene()->height());
        }
        for (Look& look : looks) {
            touch(look);
            (void)fresh->whiteAmount(look);
        }
        subject_ = std::move(fresh);
        looks_ = std::move(looks);
        problem.clear();
        watched_.watch(files());
        if (!pins.empty() && pins.front().spectrum.size() != subject_->wavelengths().size()) pins.clear();
        for (size_t& band : bands.bands)
            band = std::min(band, subject_->wavelengths().size() - 1);
        invalidate();
    } catch (const Error& error) {
        problem = error.what();
    }
    return true;
}

White Session::whiteOf(const Look& look) {
    if (white.empty()) return subject().white(look);
    return whiteFor(white, look.eye->detector, look.eye->matrix, resolver_, {});
}

Display Session::displayFor(const Look& look) const {
    if (!spectralDisplay_) return display_;
    return spectralDisplay_->seenBy(look.eye->detector.tristimulus ? look.eye->detector : standard_);
}

Rendering Session::rendering(const Look& look) {
    Rendering made;
    made.base.adaptation = adaptation;
    made.base.white = whiteOf(look);
    made.base.exposure = {ev, automatic_};
    made.base.display = displayFor(look);
    made.degree = degree;
    made.tone = tone;
    made.gamut = mapping;
    return made;
}

void Session::autoExpose() {
    DevelopSettings made = rendering(looks_[0]).base;
    made.exposure.ev = 0;
    heldLuminance = displayWhiteLuminance(subject().xyz(looks_[0]), made);
}

Shown Session::shownBy(const Rendering& how) {
    return {renderingMatrix(how, *heldLuminance * std::exp2(-ev)), how.base.display, how.tone, how.gamut};
}

Shown Session::shown(const Look& look) {
    if (!heldLuminance) autoExpose();
    return shownBy(rendering(look));
}

/// A mixture's white is the mixture of the whites, each as strong as its light.
Rendering Session::mixedRendering() {
    Rendering made = rendering(looks_[0]);
    if (white.empty()) {
        const double a = (1 - mix) * subject().whiteAmount(looks_[0]),
                     b = mix * subject().whiteAmount(looks_[1]);
        const Triple whiteA = subject().white(looks_[0]).xyz, whiteB = subject().white(looks_[1]).xyz;
        if (a + b > 0)
            for (size_t c = 0; c < 3; ++c)
                made.base.white.xyz[c] = (a * whiteA[c] + b * whiteB[c]) / (a + b);
    }
    return made;
}

void Session::drawDifference(Codes& codes) {
    const White seenAgainst = withLuminance(whiteOf(looks_[0]), *heldLuminance);
    difference = colourDifference(subject().xyz(looks_[0]), subject().xyz(looks_[1]), seenAgainst.xyz);
    const std::vector<std::uint8_t> rgb = falseColours(difference->map, differenceTop);
    codes.resize(difference->map.size());
    for (size_t i = 0; i < codes.size(); ++i)
        codes[i] = 0xff000000u | std::uint32_t{rgb[3 * i + 2]} << 16 | std::uint32_t{rgb[3 * i + 1]} << 8 |
                   rgb[3 * i];
    difference->map.clear();
}

bool Session::refresh(Codes& left, Codes& right) {
    const bool ofBands = cube() && picture != Picture::observer;
    if (!ofBands && !heldLuminance) autoExpose();
    const bool two = mode != Mode::single;
    const std::string state = fmt::format(
        "{} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", changes_, static_cast<int>(mode),
        looks_[0].version, two ? looks_[1].version : 0, static_cast<int>(adaptation), white, display,
        heldLuminance.value_or(0), ev, mode == Mode::mixture ? mix : 0,
        mode == Mode::difference ? differenceTop : 0, degree, static_cast<int>(tone),
        static_cast<int>(mapping), static_cast<int>(picture), bands.bands[0], bands.bands[1], bands.bands[2]);
    if (state == shownState_) return false;
    right.clear();
    difference.reset();
    if (ofBands) {
        BandPicture drawn = bands;
        if (picture == Picture::band) drawn.bands.fill(bands.bands[0]);
        drawn.ev = ev;
        drawn.display = displayFor(looks_[0]);
        cube()->showBands(drawn, left);
        bands.white = drawn.white;
        shownState_ = state;
        return true;
    }
    switch (mode) {
        case Mode::single:
            subject().show(looks_[0], shown(looks_[0]), left);
            break;
        case Mode::split:
            subject().show(looks_[0], shown(looks_[0]), left);
            subject().show(looks_[1], shown(looks_[1]), right);
            break;
        case Mode::mixture:
            subject().showMixed(looks_[0], looks_[1], mix, shownBy(mixedRendering()), left);
            break;
        case Mode::difference:
            drawDifference(left);
            break;
    }
    shownState_ = state;
    return true;
}

void Session::saveScene(const std::filesystem::path& target) {
    if (!scene()) throw UsageError("a cube is no scene to be saved");
    view::saveScene(*scene(), look(edited), target);
}

void Session::saveCube(const std::filesystem::path& target) {
    if (!scene()) throw UsageError("a cube is there already");
    view::saveCube(*scene(), look(edited), target, library_, software, notes_);
}

Pin Session::measured(int x, int y, const Look& look) {
    Pin pin{x, y, subject().spectrumAt(x, y, look), {}};
    if (pin.spectrum.empty()) return pin;
    const DetectorWeights weights = subject().weights(look);
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

std::string Session::pinsAsCsv() {
    const std::string unit = subject().unit(), quantity = subject().quantity();
    std::string text = fmt::format("# quantity: {}\n# unit: {}\n", quantity, unit.empty() ? "1" : unit);
    for (const Pin& pin : pins)
        text += fmt::format("# at {},{}: XYZ {} {} {}\n", pin.x, pin.y, rounded(pin.xyz[0], 6),
                            rounded(pin.xyz[1], 6), rounded(pin.xyz[2], 6));
    const std::string column = quantity == "radiance"     ? "radiance_W_m2_sr_nm"
                               : quantity == "irradiance" ? "irradiance_W_m2_nm"
                                                          : quantity;
    text += "wavelength_nm";
    for (const Pin& pin : pins)
        text += fmt::format(",{} at {} {}", column, pin.x, pin.y);
    text += '\n';
    const std::vector<double>& nm = subject().wavelengths().nm;
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
