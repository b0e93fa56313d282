// Events: keys, pointer and buttons, whether of the window or of a script.
#include "viewer/viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <imgui.h>

namespace spectrad::view {

namespace {

/// Lamps that the L key steps through.
constexpr std::array<const char*, 6> illuminants{"illuminants/D65", "illuminants/A",    "illuminants/D50",
                                                 "illuminants/FL2", "illuminants/FL11", "illuminants/LED-B3"};

}  // namespace

void Viewer::take(const Event& event) {
    ImGuiIO& io = ImGui::GetIO();
    switch (event.kind) {
        case Event::Kind::close:
            closed_ = true;
            break;
        case Event::Kind::text:
            io.AddInputCharacter(static_cast<unsigned>(event.code));
            break;
        case Event::Kind::scroll:
            io.MouseWheel += static_cast<float>(event.y);
            if (!io.WantCaptureMouse) dolly(event.y);
            break;
        case Event::Kind::key:
            modifiers_ = event.modifiers;
            io.KeyCtrl = (modifiers_ & control) != 0;
            io.KeyShift = (modifiers_ & shift) != 0;
            io.KeyAlt = (modifiers_ & alt) != 0;
            if (event.code >= 0 && event.code < static_cast<int>(keys_.size())) {
                io.KeysDown[event.code] = event.pressed;
                keys_[static_cast<size_t>(event.code)] = event.pressed && !io.WantTextInput;
            }
            if (event.pressed && !io.WantTextInput) takeKey(event);
            break;
        case Event::Kind::button: {
            if (event.code < 0 || event.code > 2) break;
            const auto which = static_cast<size_t>(event.code);
            io.MouseDown[which] = event.pressed;
            const bool ours = event.pressed && !io.WantCaptureMouse;
            if (ours) {
                pressedX_ = pointerX_;
                pressedY_ = pointerY_;
                constexpr double reach = 6;  // window units within which the divider is taken hold of
                draggingDivider_ =
                    which == 0 && session_.mode == Mode::split &&
                    std::abs(pointerX_ * panels_.scale - dividerColumn(frameWidth_)) <= reach * panels_.scale;
            }
            const bool click = held_[which] && !event.pressed && which == 0 && !draggingDivider_ &&
                               std::hypot(pointerX_ - pressedX_, pointerY_ - pressedY_) < 3;
            held_[which] = ours;
            if (!event.pressed) draggingDivider_ = false;
            if (click) {
                clicked_ = pixelUnder(pointerX_, pointerY_);
            }
            break;
        }
        case Event::Kind::move:
            takeMove(event);
            break;
    }
}

void Viewer::takeMove(const Event& event) {
    const double dx = event.x - pointerX_, dy = event.y - pointerY_;
    pointerX_ = event.x;
    pointerY_ = event.y;
    ImGui::GetIO().MousePos = {static_cast<float>(event.x) * panels_.scale,
                               static_cast<float>(event.y) * panels_.scale};
    panels_.meter.reset();
    if (draggingDivider_) {
        session_.divider = std::clamp(pointerX_ * panels_.scale / std::max(1, frameWidth_), 0.0, 1.0);
        return;
    }
    constexpr double degreesPerUnit = 0.3;
    if (held_[0] && session_.aboutScene() && (modifiers_ & shift) == 0)
        orbit(-dx * degreesPerUnit, dy * degreesPerUnit);
    else if (held_[0] || held_[2])
        pan(dx * panels_.scale, dy * panels_.scale);
    else if (held_[1])
        dolly(-0.02 * dy);
}

void Viewer::nextIlluminant() {
    Look& look = session_.look(session_.edited);
    if (look.lights.empty()) throw UsageError("there is no light to change");
    illuminant_ = (illuminant_ + 1) % illuminants.size();
    session_.setLightSpectrum(0, illuminants[illuminant_]);
}

/// ctrl + digit keeps a view of the scene, the digit goes there.
void Viewer::keepOrGo(const Event& event) {
    if (!session_.aboutScene()) return;
    std::optional<Pose>& bookmark = bookmarks_[static_cast<size_t>(event.code - '0')];
    if ((event.modifiers & control) != 0)
        bookmark = session_.stand.pose;
    else if (bookmark)
        moveTo(*bookmark);
}

void Viewer::addPin(int x, int y) {
    const std::shared_ptr<Still>& still = session_.painting().stills[0];
    if (!still) throw UsageError("a pin wants the picture with all its samples: one moment");
    Pin pin = still->measured(x, y);
    if (pin.spectrum.empty()) throw InputError(fmt::format("the pin {},{} lies outside the picture", x, y));
    session_.pins.push_back(std::move(pin));
}

void Viewer::takeKey(const Event& event) {
    const bool ctrl = (event.modifiers & control) != 0;
    if (event.code >= '1' && event.code <= '9') {
        keepOrGo(event);
        return;
    }
    if (ctrl) return;
    const auto [x, y] = pixelUnder(pointerX_, pointerY_);
    switch (event.code) {
        case tab:
            panels_.visible = !panels_.visible;
            break;
        case f1:
        case 'H':
            panels_.help = !panels_.help;
            break;
        case escape:
            panels_.help = false;
            panels_.message.clear();
            session_.stopSaving();
            break;
        case 'L':
            said([&] { nextIlluminant(); });
            break;
        case 'C':
            session_.mode = static_cast<Mode>((static_cast<int>(session_.mode) + 1) % 4);
            break;
        case 'X':
            session_.edited = 1 - session_.edited;
            break;
        case 'G':
            session_.gamutWarning = !session_.gamutWarning;
            break;
        case 'E':
            said([&] { session_.set("exposure=auto"); });
            break;
        case '[':
        case '-':
            session_.ev -= 0.25;
            break;
        case ']':
        case '=':
            session_.ev += 0.25;
            break;
        case 'P':
            said([&] { addPin(x, y); });
            break;
        case 'F':
            frameAll();
            break;
        case home:
            toHome();
            break;
        case 'Q':
            closed_ = true;
            break;
        default:
            break;
    }
}

}  // namespace spectrad::view
