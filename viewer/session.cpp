#include "viewer/session.h"

#include "viewer/carry.h"
#include "viewer/save.h"

#include <algorithm>
#include <utility>

namespace spectrad::view {

Session::Session(Opener open, const Library& library, Notes& notes, bool restricted)
    : open_(std::move(open)),
      library_(library),
      restricted_(restricted),
      painter_(std::make_unique<Painter>(open_(notes), library_, restricted_)),
      notes_(notes),
      resolver_(library_, about().file().parent_path(), restricted_, notes_),
      standard_(standardObserver(library_)) {
    looks = {about().firstLook(), about().firstLook()};
    for (Look& look : looks)
        touch(look);
    if (const SceneSubject* scene = aboutScene())
        stand = {scene->home(), scene->width(), scene->height(), std::nullopt};
    watched_.watch(files());
    const size_t last = about().wavelengths().size() - 1;
    bands.bands = {last * 3 / 4, last / 2, last / 4};
}

std::vector<std::filesystem::path> Session::files() const {
    std::vector<std::filesystem::path> all = about().files();
    for (const Look& look : looks) {
        for (const LightSetting& light : look.lights)
            all.insert(all.end(), light.emitter.spectrum.files.begin(), light.emitter.spectrum.files.end());
        for (const auto& [material, reflectance] : look.reflectances)
            all.insert(all.end(), reflectance.files.begin(), reflectance.files.end());
    }
    return all;
}

Painter& Session::atHand() {
    if (paints_.running()) takePainting();
    painter_->subject().heed({});
    painter_->subject().stand(stand);
    return *painter_;
}

void Session::check(const Look& look) {
    if (waits) (void)subject().whiteAmount(look);
}

std::string Session::state(const Wish& wish, std::uint64_t changes) const {
    return wish.key() + " " + std::to_string(changes);
}

/// Looks that cannot be painted go back to those that could.
void Session::takeBack() {
    if (painting_.left.empty()) return;
    looks = painting_.wish.looks;
    white = painting_.wish.white;  // a pixel's, where there is no light now
    watched_.watch(files());
}

void Session::show(Painting&& painting) {
    const Wish& answered = painting.wish;
    const bool stillAsked = looks[0].version == answered.looks[0].version && white == answered.white &&
                            automatic == answered.automatic;
    if (!heldLuminance && stillAsked) heldLuminance = answered.heldLuminance;
    bands.white = answered.bands.white;
    spare_ = std::exchange(painting_, std::move(painting));
    painted_ = state(painting_.wish, changesPainted_);
    news_.picture = true;
}

void Session::takePainting() {
    try {
        if (const std::optional<Painted> made = paints_.take()) show(std::move(**made));
    } catch (const Error& error) {
        failed_ = beingPainted_;
        news_.problem = error.what();
        if (failed_ == state(*this, changes_)) takeBack();
    }
}

bool Session::begin() {
    const std::string wanted = state(*this, changes_);
    if (paints_.running()) {
        // One sample a pixel is what a hand that moves waits for; what takes longer makes room for its
        // successor.
        if (wanted != beingPainted_ && !hasty_) paints_.stop();
        return false;
    }
    if (wanted == painted_ || wanted == failed_) return false;
    beingPainted_ = wanted;
    changesPainted_ = changes_;
    if (waits) {
        try {
            painter_->paint(*this, spare_);
            show(std::move(spare_));
        } catch (const Error&) {
            failed_ = wanted;
            takeBack();
            throw;
        }
        news_.picture = false;
        return true;
    }
    hasty_ = stand.samples == 1;
    auto target = std::make_shared<Painting>(std::move(spare_));
    paints_.start([painter = painter_.get(), wish = Wish(*this), target](const std::stop_token& stop) {
        painter->paint(wish, *target, stop);
        return target;
    });
    return false;
}

bool Session::settled() const {
    if (paints_.running() || opens_.running()) return false;
    const std::string now = state(*this, changes_);
    return now == painted_ || now == failed_;
}

Job<Session::Opened>::Work Session::opening() {
    // The old subject stays until the new one is taken over: what never changes of it can be asked.
    return [open = open_, &library = library_, restricted = restricted_, before = &about(),
            looks = looks](const std::stop_token& stop) {
        Notes unsaid;
        auto fresh = std::make_unique<Painter>(open(unsaid), library, restricted);
        throwIfStopped(stop);
        const SpectrumResolver resolver(library, before->file().parent_path(), restricted, unsaid);
        std::uint64_t version = ~std::uint64_t{0};
        for (const Look& look : looks) {
            Look tried = carried(look, *before, fresh->about(), resolver);
            tried.version = version--;
            (void)fresh->subject().whiteAmount(tried);
        }
        return fresh;
    };
}

void Session::takeOpened(Opened fresh) {
    std::array<Look, 2> now{carried(looks[0], about(), fresh->about(), resolver_),
                            carried(looks[1], about(), fresh->about(), resolver_)};
    stand = carried(stand, about(), fresh->about());
    for (Look& look : now)
        touch(look);
    looks = std::move(now);
    painter_ = std::move(fresh);
    problem.clear();
    watched_.watch(files());
    const size_t count = about().wavelengths().size();
    if (!pins.empty() && pins.front().spectrum.size() != count) pins.clear();
    for (size_t& band : bands.bands)
        band = std::min(band, count - 1);
    invalidate();
}

bool Session::reload() {
    if (!watched_.changed()) return false;
    try {
        (void)atHand();
        takeOpened(opening()({}));
    } catch (const Error& error) {
        problem = error.what();
    }
    return true;
}

News Session::take() {
    if (paints_.done()) takePainting();
    if (saves_.done()) {
        try {
            const std::optional<std::string> file = saves_.take();
            news_.remark = file ? "wrote " + *file : "stopped: nothing is left of " + saving_;
        } catch (const Error& error) {
            news_.problem = error.what();
            failedSave_ = std::current_exception();
        }
    }
    if (waits && !opens_.running()) {
        news_.opened = reload();
    } else {
        changedAgain_ = watched_.changed() || changedAgain_;
        if (changedAgain_ && !opens_.running()) {
            changedAgain_ = false;
            opens_.start(opening());
        }
        // What is being painted of the old subject is of no use any more.
        if (opens_.done() && paints_.running()) paints_.stop();
        if (opens_.done() && !paints_.running()) {
            try {
                if (std::optional<Opened> fresh = opens_.take()) takeOpened(std::move(*fresh));
            } catch (const Error& error) {
                problem = error.what();
            }
            news_.opened = true;
        }
    }
    if (news_.opened) news_.problem = problem;
    return std::exchange(news_, {});
}

void Session::await(double seconds) const {
    if (paints_.running())
        (void)paints_.waited(seconds);
    else if (opens_.running())
        (void)opens_.waited(seconds);
    else
        (void)saves_.waited(seconds);
}

}  // namespace spectrad::view
