#include "viewer/painter.h"

#include "camera/film_picture.h"
#include "colour/image_white.h"
#include "viewer/cube_subject.h"
#include "viewer/scene_subject.h"

#include <cmath>
#include <utility>

namespace spectrad::view {

Painter::Painter(std::unique_ptr<Subject> subject, const Library& library, bool restricted)
    : subject_(std::move(subject)),
      resolver_(library, subject_->file().parent_path(), restricted, unsaid_),
      standard_(std::make_shared<const Eye>(standardEye(library))) {}

White Painter::whiteOf(const Wish& wish, const Look& look) {
    if (look.film) return projectionWhite(*look.film);
    if (isOfImage(wish.white)) return whiteOfImage(wish.white, subject_->xyz(look));
    if (wish.white.empty()) return subject_->white(look);
    return whiteFor(wish.white, look.eye->detector, look.eye->matrix, resolver_, {});
}

ChannelImage Painter::developed(const Wish& wish, const Look& look, ChannelImage channels) {
    const double metered = meteredBy(*look.film, channels, wish.white);
    return projected(*look.film, std::move(channels), metered, wish.ev);
}

ChannelImage Painter::seen(const Wish& wish, const Look& look) {
    ChannelImage xyz = subject_->xyz(look);
    return look.film ? developed(wish, look, std::move(xyz)) : xyz;
}

Rendering Painter::rendering(const Wish& wish, const Look& look) {
    Rendering made;
    made.base.adaptation = wish.adaptation;
    made.base.white = whiteOf(wish, look);
    // A film is exposed, its projection is not.
    if (!look.film) made.base.exposure = {wish.ev, wish.automatic};
    made.base.display = wish.displayFor(look, standard_->detector);
    made.degree = wish.degree;
    made.tone = wish.tone;
    made.gamut = wish.mapping;
    return made;
}

/// A mixture's white is the mixture of the whites, each as strong as its light.
Rendering Painter::mixedRendering(const Wish& wish) {
    const Look &first = wish.looks[0], &second = wish.looks[1];
    Rendering made = rendering(wish, first);
    if (wish.white.empty()) {
        const double a = (1 - wish.mix) * subject_->whiteAmount(first),
                     b = wish.mix * subject_->whiteAmount(second);
        const Triple whiteA = subject_->white(first).xyz, whiteB = subject_->white(second).xyz;
        if (a + b > 0)
            for (size_t c = 0; c < 3; ++c)
                made.base.white.xyz[c] = (a * whiteA[c] + b * whiteB[c]) / (a + b);
    }
    return made;
}

Shown Painter::shown(const Wish& wish, const Look& look, const Rendering& how) {
    const double luminance = look.film ? how.base.white.xyz[1] : *wish.heldLuminance * std::exp2(-wish.ev);
    return {renderingMatrix(how, luminance), how.base.display, how.tone, how.gamut};
}

double Painter::measuredLuminance(const Wish& wish) {
    const Look& look = wish.looks[0].film ? wish.looks[1] : wish.looks[0];
    DevelopSettings made = rendering(wish, look).base;
    if (look.film) return made.white.xyz[1];
    made.exposure.ev = 0;
    return displayWhiteLuminance(subject_->xyz(look), made);
}

void Painter::paintLook(const Wish& wish, const Look& look, Codes& codes) {
    const Shown how = shown(wish, look, rendering(wish, look));
    if (look.film)
        encodeCodes(seen(wish, look), how, codes);
    else
        subject_->show(look, how, codes);
}

void Painter::paintMixture(const Wish& wish, Codes& codes) {
    const Look &a = wish.looks[0], &b = wish.looks[1];
    if (!a.film && !b.film) {
        subject_->showMixed(a, b, wish.mix, shown(wish, a, mixedRendering(wish)), codes);
        return;
    }
    if (a.eye->detector.name != b.eye->detector.name)
        throw UsageError("a mixture of light on a film wants both looks on the same film");
    ChannelImage mixed = subject_->xyz(a);
    const ChannelImage other = subject_->xyz(b);
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < mixed.pixels(); ++i)
            mixed.plane[c][i] = std::lerp(mixed.plane[c][i], other.plane[c][i], wish.mix);
    encodeCodes(developed(wish, a, std::move(mixed)), shown(wish, a, rendering(wish, a)), codes);
}

void Painter::paintBands(Painting& painting) {
    Wish& wish = painting.wish;
    BandPicture drawn = wish.bands;
    if (wish.picture == Picture::band) drawn.bands.fill(drawn.bands[0]);
    drawn.ev = wish.ev;
    drawn.display = wish.displayFor(wish.looks[0], standard_->detector);
    dynamic_cast<CubeSubject&>(*subject_).showBands(drawn, painting.left);
    wish.bands.white = drawn.white;
}

void Painter::paintDifference(Painting& painting) {
    const Wish& wish = painting.wish;
    const Look &a = wish.looks[0], &b = wish.looks[1];
    if (!a.film != !b.film) throw UsageError("a colour difference wants both looks on film, or neither");
    const White seenAgainst = withLuminance(whiteOf(wish, a), *wish.heldLuminance);
    painting.difference = colourDifference(seen(wish, a), seen(wish, b), seenAgainst.xyz);
    const std::vector<float>& map = painting.difference->map;
    const std::vector<std::uint8_t> rgb = falseColours(map, wish.differenceTop);
    painting.left.resize(map.size());
    for (size_t i = 0; i < map.size(); ++i)
        painting.left[i] = 0xff000000u | std::uint32_t{rgb[3 * i + 2]} << 16 |
                           std::uint32_t{rgb[3 * i + 1]} << 8 | rgb[3 * i];
    painting.difference->map.clear();
}

void Painter::paint(const Wish& wish, Painting& painting, const std::stop_token& stop) {
    painting.wish = wish;
    painting.right.clear();
    painting.difference.reset();
    painting.stills = {};
    auto* scene = dynamic_cast<SceneSubject*>(subject_.get());
    painting.width = scene ? wish.stand.width : subject_->width();
    painting.height = scene ? wish.stand.height : subject_->height();
    Wish& asked = painting.wish;
    const Look &a = asked.looks[0], &b = asked.looks[1];
    const bool finished =
        !scene || asked.stand.samples.value_or(scene->finalSamples()) >= scene->finalSamples();
    const auto keep = [&](size_t which) {
        if (!finished) return;
        Look look = asked.looks[which];
        if (look.film) look.eye = standard_;  // as measure prints X Y Z of a film
        painting.stills[which] = subject_->still(look);
    };
    subject_->heed(stop);
    subject_->stand(asked.stand);
    if (!scene && asked.picture != Picture::observer) {
        paintBands(painting);
        keep(0);
        return;
    }
    if (!asked.heldLuminance) asked.heldLuminance = measuredLuminance(asked);
    switch (asked.mode) {
        case Mode::single:
            paintLook(asked, a, painting.left);
            break;
        case Mode::split:
            paintLook(asked, a, painting.left);
            keep(0);
            paintLook(asked, b, painting.right);
            keep(1);
            return;
        case Mode::mixture:
            paintMixture(asked, painting.left);
            break;
        case Mode::difference:
            paintDifference(painting);
            break;
    }
    keep(0);
}

}  // namespace spectrad::view
