// Scripts: each action played to its end.
#include "base/files.h"
#include "image/picture_colour.h"
#include "viewer/viewer.h"

#include <fmt/format.h>

#include <utility>

namespace spectrad::view {

Picture8 Viewer::pictureAlone() {
    const Painting& shown = session_.painting();
    const int width = shown.width;
    Picture8 alone{width, shown.height, 3, {}};
    alone.pixels.reserve(3 * shown.left.size());
    const bool split = shown.wish.mode == Mode::split && !shown.right.empty();
    const int divider = split ? dividerColumn(width) : width;
    for (size_t i = 0; i < shown.left.size(); ++i) {
        const bool right = static_cast<int>(i % static_cast<size_t>(width)) >= divider;
        const std::uint32_t code = right ? shown.right[i] : shown.left[i];
        for (const int shift : {0, 8, 16})
            alone.pixels.push_back(static_cast<std::uint8_t>(code >> shift & 255));
    }
    return alone;
}

void Viewer::writeAlone(const std::filesystem::path& target) {
    if (target.extension() != ".png")
        throw UsageError("'" + target.string() + "' must end in .png to be a picture");
    writePng(target, pictureAlone(),
             {{"Software", session_.software},
              {"Description", fmt::format("{} seen by {}", session_.about().file().string(),
                                          session_.look(0).eye->detector.name)}},
             pictureColour(session_.displayForStandard()));
}

void Viewer::savePicture(const std::filesystem::path& target) {
    (void)picture();
    writeAlone(target);
}

void Viewer::writeWanted() {
    if (!panels_.wanted || !settled_) return;
    const Wanted wanted = *std::exchange(panels_.wanted, std::nullopt);
    said([&] {
        switch (wanted.what) {
            case Wanted::What::picture:
                writeAlone(wanted.file);
                break;
            case Wanted::What::cube:
                session_.saveCube(wanted.file);
                break;
            case Wanted::What::scene:
                session_.saveScene(wanted.file);
                break;
            case Wanted::What::pins:
                writeFile(wanted.file, session_.pinsAsCsv());
                break;
        }
        if (wanted.what != Wanted::What::cube || session_.waits) panels_.remark = "wrote " + wanted.file;
    });
}

void Viewer::play(const Action& action) {
    const int x = static_cast<int>(action.x), y = static_cast<int>(action.y);
    switch (action.kind) {
        case Action::Kind::events:
            queue_.insert(queue_.end(), action.events.begin(), action.events.end());
            break;
        case Action::Kind::set:
            session_.set(action.text);
            break;
        case Action::Kind::camera:
            if (action.text == "orbit") orbit(action.x, action.y);
            if (action.text == "pan") pan(action.x, action.y);
            if (action.text == "dolly") dolly(action.x);
            if (action.text == "frame") frameAll();
            if (action.text == "reset") toHome();
            break;
        case Action::Kind::resize:
            face_.resize(x, y);
            break;
        case Action::Kind::screenshot: {
            const FaceSize size = face_.size();
            if (size.pixelWidth < 1 || size.pixelHeight < 1)
                throw InputError("a window of no size has no screenshot");
            writePng(action.text, picture(), {}, pictureColour(session_.displayForStandard()));
            return;
        }
        case Action::Kind::savePicture:
            savePicture(action.text);
            return;
        case Action::Kind::saveCube:
            session_.saveCube(action.text);
            return;
        case Action::Kind::saveScene:
            session_.saveScene(action.text);
            return;
        case Action::Kind::channels: {
            (void)picture();
            const ChannelImage xyz = session_.seen(session_.look(0));
            const std::vector<std::string> names{"X", "Y", "Z"};
            writeChannelsExr(action.text, xyz.width, xyz.height, names, floatPlanes(xyz, names),
                             {{"observer", session_.look(0).eye->detector.name}, {"unit", "cd.m^-2 (Y)"}});
            return;
        }
        case Action::Kind::pin: {
            (void)picture();
            addPin(x, y);
            return;
        }
        case Action::Kind::pins:
            writeFile(action.text, session_.pinsAsCsv());
            return;
        case Action::Kind::wait:
            for (int i = 0; i < x && !closed_; ++i)
                frame(0);
            return;
        case Action::Kind::jobs:
            session_.waits = x != 0;
            return;
        case Action::Kind::finish:
            finish();
            return;
        case Action::Kind::close:
            closed_ = true;
            return;
    }
    do
        frame(0);
    while (!queue_.empty() && !closed_);
}

void run(Viewer& viewer, const std::vector<Action>& actions, std::optional<int> frames) {
    for (const Action& action : actions) {
        if (viewer.closed()) return;
        try {
            viewer.play(action);
        } catch (const MachineError&) {
            throw;
        } catch (const Error& error) {
            throw InputError(action.where, error.what());
        }
    }
    constexpr double patience = 0.1;  // s: how often an idle window looks whether files have changed
    for (int i = 0; (!frames || i < *frames) && !viewer.closed(); ++i)
        viewer.frame(frames ? 0 : patience);
}

}  // namespace spectrad::view
