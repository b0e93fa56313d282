#include "viewer/painter.h"

#include "colour/white.h"
#include "viewer/cube_subject.h"
#include "viewer/scene_subject.h"

#include <cmath>
#include <utility>

namespace spectrad::view {

Painter::Painter(std::unique_ptr<Subject> subject, const Library& library, bool restricted)
    : subject_(std::move(subject)),
      resolver_(library, subject_->file().parent_path(), restricted, unsaid_),
      standard_(standardObserver(library)) {}

White Painter::whiteOf(const Wish& wish, const Look& look) {
    if (wish.white.empty()) return subject_->white(look);
    return whiteFor(wish.white, look.eye->detector, look.eye->matrix, resolver_, {});
}

Rendering Painter::rendering(const Wish& wish, const Look& look) {
    Rendering made;
    made.base.adaptation = wish.adaptation;
    made.base.white = whiteOf(wish, look);
    made.base.exposure = {wish.ev, wish.automatic};
    made.base.display = wish.displayFor(look, standard_);
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

Shown Painter::shown(const Wish& wish, const Rendering& how) {
    return {renderingMatrix(how, *wish.heldLuminance * std::exp2(-wish.ev)), how.base.display, how.tone,
            how.gamut};
}

double Painter::measuredLuminance(const Wish& wish) {
    DevelopSettings made = rendering(wish, wish.looks[0]).base;
    made.exposure.ev = 0;
    return displayWhiteLuminance(subject_->xyz(wish.looks[0]), made);
}

void Painter::paintBands(Painting& painting) {
    Wish& wish = painting.wish;
    BandPicture drawn = wish.bands;
    if (wish.picture == Picture::band) drawn.bands.fill(drawn.bands[0]);
    drawn.ev = wish.ev;
    drawn.display = wish.displayFor(wish.looks[0], standard_);
    dynamic_cast<CubeSubject&>(*subject_).showBands(drawn, painting.left);
    wish.bands.white = drawn.white;
}

void Painter::paintDifference(Painting& painting) {
    const Wish& wish = painting.wish;
    const White seenAgainst = withLuminance(whiteOf(wish, wish.looks[0]), *wish.heldLuminance);
    painting.difference =
        colourDifference(subject_->xyz(wish.looks[0]), subject_->xyz(wish.looks[1]), seenAgainst.xyz);
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
        if (finished) painting.stills[which] = subject_->still(asked.looks[which]);
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
            subject_->show(a, shown(asked, rendering(asked, a)), painting.left);
            break;
        case Mode::split:
            subject_->show(a, shown(asked, rendering(asked, a)), painting.left);
            keep(0);
            subject_->show(b, shown(asked, rendering(asked, b)), painting.right);
            keep(1);
            return;
        case Mode::mixture:
            subject_->showMixed(a, b, asked.mix, shown(asked, mixedRendering(asked)), painting.left);
            break;
        case Mode::difference:
            paintDifference(painting);
            break;
    }
    keep(0);
}

}  // namespace spectrad::view
