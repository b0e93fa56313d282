#include "viewer/viewer.h"

#include "base/error.h"
#include "base/files.h"
#include "base/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <imgui.h>

namespace spectrad::view {

namespace {

/// Lamps that the L key steps through.
constexpr std::array<const char*, 6> illuminants{"illuminants/D65", "illuminants/A",    "illuminants/D50",
                                                 "illuminants/FL2", "illuminants/FL11", "illuminants/LED-B3"};

void style(float scale) {
    ImGui::StyleColorsDark();
    ImGuiStyle& s = ImGui::GetStyle();
    s.WindowRounding = 6;
    s.FrameRounding = s.GrabRounding = s.PopupRounding = 4;
    s.WindowBorderSize = 0;
    s.FramePadding = {7, 4};
    s.ItemSpacing = {8, 6};
    s.Colors[ImGuiCol_WindowBg] = {0.09f, 0.09f, 0.10f, 0.90f};
    s.Colors[ImGuiCol_FrameBg] = {0.20f, 0.20f, 0.22f, 1};
    s.Colors[ImGuiCol_Header] = {0.22f, 0.30f, 0.38f, 1};
    s.Colors[ImGuiCol_TitleBg] = s.Colors[ImGuiCol_TitleBgActive] = {0.13f, 0.13f, 0.15f, 1};
    s.Colors[ImGuiCol_CheckMark] = s.Colors[ImGuiCol_SliderGrab] = {0.55f, 0.75f, 0.95f, 1};
    s.ScaleAllSizes(scale);
}

}  // namespace

Viewer::Viewer(Face& face, Session& session)
    : face_(face), session_(session), imgui_(ImGui::CreateContext()), canvas_(face) {
    const FaceSize size = face_.size();
    panels_.scale = size.width > 0 ? static_cast<float>(size.pixelWidth) / static_cast<float>(size.width) : 1;
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    for (const auto& [ours, theirs] :
         std::initializer_list<std::pair<int, int>>{{ImGuiKey_Tab, tab},
                                                    {ImGuiKey_LeftArrow, left},
                                                    {ImGuiKey_RightArrow, right},
                                                    {ImGuiKey_UpArrow, up},
                                                    {ImGuiKey_DownArrow, down},
                                                    {ImGuiKey_Home, home},
                                                    {ImGuiKey_End, end},
                                                    {ImGuiKey_Delete, del},
                                                    {ImGuiKey_Backspace, backspace},
                                                    {ImGuiKey_Enter, enter},
                                                    {ImGuiKey_Escape, escape},
                                                    {ImGuiKey_A, 'A'},
                                                    {ImGuiKey_C, 'C'},
                                                    {ImGuiKey_V, 'V'},
                                                    {ImGuiKey_X, 'X'},
                                                    {ImGuiKey_Y, 'Y'},
                                                    {ImGuiKey_Z, 'Z'},
                                                    {ImGuiKey_Space, ' '}})
        io.KeyMap[ours] = theirs;
    style(panels_.scale);
    // A font for reading where the system has one, else the one that is built in.
    constexpr const char* readable = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
    static const ImWchar letters[] = {0x20,   0xff,   0x394,  0x394, 0x3bb, 0x3bb,  0x2032,
                                      0x2032, 0x207b, 0x207b, 0xb2,  0xb3,  0x2013, 0x2013,
                                      0x2026, 0x2026, 0xd7,   0xd7,  0};
    if (std::error_code ignored; std::filesystem::exists(readable, ignored))
        io.Fonts->AddFontFromFileTTF(readable, std::round(14 * panels_.scale), nullptr, letters);
    else
        io.Fonts->AddFontDefault();
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    font_ = canvas_.makeTexture(true);
    canvas_.upload(font_, width, height, reinterpret_cast<const std::uint32_t*>(pixels));
    io.Fonts->SetTexID(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(font_)));
    left_ = canvas_.makeTexture(false);
    right_ = canvas_.makeTexture(false);
    home_ = session_.scene().pose();
    prepare(panels_, session_);
}

Viewer::~Viewer() {
    ImGui::DestroyContext(imgui_);
}

template <typename Call>
void Viewer::said(Call call) {
    try {
        call();
        panels_.message.clear();
    } catch (const InputError& error) {
        panels_.message = error.what();
    } catch (const UsageError& error) {
        panels_.message = error.what();
    }
}

std::array<int, 2> Viewer::pixelUnder(double x, double y) const {
    return {static_cast<int>(std::floor(x * panels_.scale)), static_cast<int>(std::floor(y * panels_.scale))};
}

void Viewer::resizePicture(const FaceSize& size) {
    SceneSubject& scene = session_.scene();
    if (scene.width() == size.pixelWidth && scene.height() == size.pixelHeight) return;
    scene.setSize(size.pixelWidth, size.pixelHeight);
    session_.invalidate();
    settled_ = false;
}

void Viewer::frame(double seconds) {
    const Stopwatch clock;
    for (const Event& event : face_.events(queue_.empty() && settled_ ? seconds : 0))
        queue_.push_back(event);
    // A press and its release are seen in two frames, and whose press it is (a panel's or the picture's) is
    // known only in the frame after the pointer came.
    bool moved = false;
    while (!queue_.empty()) {
        const Event event = queue_.front();
        if (event.kind == Event::Kind::button && moved) break;
        moved = moved || event.kind == Event::Kind::move;
        queue_.pop_front();
        take(event);
        if (event.kind == Event::Kind::button || event.kind == Event::Kind::key) break;
    }
    const FaceSize size = face_.size();
    if (size.pixelWidth < 1 || size.pixelHeight < 1) {  // minimised: nothing to draw into
        settled_ = true;
        return;
    }
    resizePicture(size);
    fly();
    const bool moving = held_[0] || held_[1] || held_[2];
    const int final = session_.scene().finalSamples();
    constexpr int refine = 4;  // times as many samples in each idle frame
    const int wanted = moving && !settled_ ? 1 : std::min(final, settled_ ? final : samples_ * refine);
    if (wanted != session_.scene().samples()) {
        session_.scene().setSamples(wanted);
        session_.invalidate();
    }
    samples_ = wanted;
    said([&] {
        if (session_.refresh(leftPixels_, rightPixels_)) {
            canvas_.upload(left_, session_.subject().width(), session_.subject().height(),
                           leftPixels_.data());
            if (!rightPixels_.empty())
                canvas_.upload(right_, session_.subject().width(), session_.subject().height(),
                               rightPixels_.data());
            panels_.meter.reset();
        }
    });
    settled_ = samples_ >= final;
    panels_.samples = samples_;
    draw(size);
    face_.present();
    panels_.frameSeconds = clock.seconds();
}

void Viewer::draw(const FaceSize& size) {
    const Subject& subject = session_.subject();
    const bool inside = !ImGui::GetIO().WantCaptureMouse;
    const auto [x, y] = pixelUnder(pointerX_, pointerY_);
    const int divider = static_cast<int>(std::lround(session_.divider * subject.width()));
    const bool overRight = session_.mode == Mode::split && x >= divider;
    if (panels_.visible && settled_ && inside && !panels_.meter)
        said([&] {
            Pin pin = session_.measured(x, y, session_.look(overRight ? 1 : 0));
            if (!pin.spectrum.empty()) panels_.meter = std::move(pin);
        });
    canvas_.begin(size.pixelWidth, size.pixelHeight);
    const bool zebra = session_.gamutWarning && session_.mode != Mode::difference;
    if (session_.mode == Mode::split && !rightPixels_.empty()) {
        canvas_.drawPicture(left_, subject.width(), subject.height(), 0, divider, zebra);
        canvas_.drawPicture(right_, subject.width(), subject.height(), divider, subject.width(), zebra);
    } else {
        canvas_.drawPicture(left_, subject.width(), subject.height(), 0, subject.width(), zebra);
    }
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(size.pixelWidth), static_cast<float>(size.pixelHeight)};
    io.DeltaTime = 1.0f / 60;
    ImGui::NewFrame();
    const std::uint64_t before = session_.look(0).version + session_.look(1).version;
    drawPanels(session_, panels_, io.DisplaySize.x, io.DisplaySize.y);
    if (before != session_.look(0).version + session_.look(1).version) settled_ = false;
    ImGui::Render();
    canvas_.drawInterface(*ImGui::GetDrawData());
    canvas_.end();
}

Picture8 Viewer::picture() {
    do
        frame(0);
    while (!settled());
    // Panels that a change has made show it in the next frame.
    frame(0);
    return canvas_.read();
}

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
                    std::abs(pointerX_ * panels_.scale - session_.divider * session_.subject().width()) <=
                        reach * panels_.scale;
            }
            const bool click = held_[which] && !event.pressed && which == 0 && !draggingDivider_ &&
                               std::hypot(pointerX_ - pressedX_, pointerY_ - pressedY_) < 3;
            held_[which] = ours;
            if (!event.pressed) draggingDivider_ = false;
            if (click) {
                const auto [x, y] = pixelUnder(pointerX_, pointerY_);
                select(x, y);
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
        session_.divider =
            std::clamp(pointerX_ * panels_.scale / std::max(1, session_.subject().width()), 0.0, 1.0);
        return;
    }
    constexpr double degreesPerUnit = 0.3;
    if (held_[0] && (modifiers_ & shift) == 0)
        orbit(-dx * degreesPerUnit, dy * degreesPerUnit);
    else if (held_[0] || held_[2])
        pan(dx * panels_.scale, dy * panels_.scale);
    else if (held_[1])
        dolly(-0.02 * dy);
}

void Viewer::select(int x, int y) {
    said([&] { panels_.selected = session_.scene().hitAt(x, y); });
}

void Viewer::nextIlluminant() {
    Look& look = session_.look(session_.edited);
    if (look.lights.empty()) throw UsageError("the scene has no light to change");
    illuminant_ = (illuminant_ + 1) % illuminants.size();
    session_.setLightSpectrum(0, illuminants[illuminant_]);
}

void Viewer::takeKey(const Event& event) {
    const bool ctrl = (event.modifiers & control) != 0;
    if (event.code >= '1' && event.code <= '9') {
        std::optional<Pose>& bookmark = bookmarks_[static_cast<size_t>(event.code - '0')];
        if (ctrl)
            bookmark = session_.scene().pose();
        else if (bookmark) {
            session_.scene().setPose(*bookmark);
            session_.invalidate();
            settled_ = false;
        }
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
            said([&] {
                Pin pin = session_.measured(x, y, session_.look(0));
                if (!pin.spectrum.empty()) session_.pins.push_back(std::move(pin));
            });
            break;
        case 'F': {
            const auto [middle, radius] = session_.scene().bounds();
            frameAt(panels_.selected ? panels_.selected->place : middle,
                    panels_.selected ? radius / 4 : radius);
            break;
        }
        case home:
            session_.scene().setPose(home_);
            session_.invalidate();
            settled_ = false;
            break;
        case 'Q':
            closed_ = true;
            break;
        default:
            break;
    }
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
            if (action.text == "frame") {
                const auto [middle, radius] = session_.scene().bounds();
                frameAt(middle, radius);
            }
            if (action.text == "reset") {
                session_.scene().setPose(home_);
                session_.invalidate();
                settled_ = false;
            }
            break;
        case Action::Kind::resize:
            face_.resize(x, y);
            break;
        case Action::Kind::screenshot: {
            const FaceSize size = face_.size();
            if (size.pixelWidth < 1 || size.pixelHeight < 1)
                throw InputError("a window of no size has no screenshot");
            writePng(action.text, picture());
            return;
        }
        case Action::Kind::channels: {
            (void)picture();
            const ChannelImage xyz = session_.subject().xyz(session_.look(0));
            const std::vector<std::string> names{"X", "Y", "Z"};
            writeChannelsExr(action.text, xyz.width, xyz.height, names, floatPlanes(xyz, names),
                             {{"observer", session_.look(0).eye->detector.name}, {"unit", "cd.m^-2 (Y)"}});
            return;
        }
        case Action::Kind::pin: {
            (void)picture();
            Pin pin = session_.measured(x, y, session_.look(0));
            if (pin.spectrum.empty())
                throw InputError(fmt::format("the pin {},{} lies outside the picture", x, y));
            session_.pins.push_back(std::move(pin));
            return;
        }
        case Action::Kind::pins:
            writeFile(action.text, session_.pinsAsCsv());
            return;
        case Action::Kind::wait:
            for (int i = 0; i < x && !closed_; ++i)
                frame(0);
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
        viewer.play(action);
    }
    constexpr double patience = 0.1;  // s: how often an idle window looks whether files have changed
    for (int i = 0; (!frames || i < *frames) && !viewer.closed(); ++i)
        viewer.frame(frames ? 0 : patience);
}

}  // namespace spectrad::view
