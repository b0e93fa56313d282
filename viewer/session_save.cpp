// What of a session goes to files, and what is said of work under way.
#include "viewer/save.h"
#include "viewer/session.h"

#include <fmt/format.h>

namespace spectrad::view {

void Session::saveScene(const std::filesystem::path& target) {
    const SceneSubject* scene = aboutScene();
    if (!scene) throw UsageError("a cube is no scene to be saved");
    view::saveScene(*scene, look(edited), stand.pose, target);
}

void Session::saveCube(const std::filesystem::path& target) {
    const SceneSubject* scene = aboutScene();
    if (!scene) throw UsageError("a cube is there already");
    if (saves_.running()) throw UsageError("'" + saving_ + "' is still being written");
    CubeOrder order = cubeOrder(*scene, look(edited), stand, target, software);
    if (waits) return writeCube(order, library_, {}, {});
    saving_ = target.string();
    saved_->store(0);
    saves_.start(
        [order = std::move(order), &library = library_, saved = saved_](const std::stop_token& stop) {
            writeCube(
                order, library, [&](double share) { saved->store(share); }, stop);
            return order.target.string();
        });
}

void Session::rethrowFailedSave() {
    if (failedSave_) std::rethrow_exception(std::exchange(failedSave_, nullptr));
}

std::string Session::pinsAsCsv() const {
    return view::pinsAsCsv(pins, about().wavelengths(), about().kind());
}

std::string Session::busy() const {
    constexpr double worthTelling = 0.3;  // s
    std::string text;
    const auto add = [&](const std::string& what) { text += (text.empty() ? "" : "   ") + what; };
    if (saves_.running())
        add(fmt::format("writing {}: {:.0f} % (escape stops it)", saving_, 100 * saved_->load()));
    if (opens_.running() && opens_.seconds() > worthTelling)
        add(fmt::format("opening {}: {:.0f} s", about().file().string(), opens_.seconds()));
    if (paints_.running() && paints_.seconds() > worthTelling)
        add(fmt::format("painting: {:.1f} s", paints_.seconds()));
    return text;
}

}  // namespace spectrad::view
