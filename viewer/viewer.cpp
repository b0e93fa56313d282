#include "viewer/viewer.h"

#include "base/error.h"
#include "base/files.h"
#include "base/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <imgui.h>
#include <utility>

namespace spectrad::view {

namespace {

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
    s.Colors[ImGuiCol_CheckMark] = {0.55f, 0.75f, 0.95f, 1};
    s.Colors[ImGuiCol_SliderGrab] = {0.55f, 0.75f, 0.95f, 0.5f};  // its number is read through it
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
    panels_.frameOf = [this](int x, int y) {
        if (!session_.aboutScene()) return place_.frameOf(x, y);
        const Painting& shown = session_.painting();
        return std::array{(x + 0.5) * frameWidth_ / std::max(1, shown.width),
                          (y + 0.5) * frameHeight_ / std::max(1, shown.height)};
    };
    prepare(panels_, session_);
}

Viewer::~Viewer() {
    ImGui::DestroyContext(imgui_);
}

std::array<int, 2> Viewer::frameAt(double x, double y) const {
    return {static_cast<int>(std::floor(x * panels_.scale)), static_cast<int>(std::floor(y * panels_.scale))};
}

std::array<int, 2> Viewer::pixelUnder(double x, double y) const {
    const auto [column, row] = frameAt(x, y);
    if (!session_.aboutScene()) return place_.pixelAt(column, row);
    // Of another size than the frame while the one of that size is being made.
    const Painting& shown = session_.painting();
    const auto along = [](int at, int pixels, int frame) {
        return pixels == frame || frame < 1 ? at : static_cast<int>(std::floor((at + 0.5) * pixels / frame));
    };
    return {along(column, shown.width, frameWidth_), along(row, shown.height, frameHeight_)};
}

int Viewer::dividerColumn(int frameWidth) const {
    return static_cast<int>(std::lround(session_.divider * frameWidth));
}

void Viewer::resizePicture(const FaceSize& size) {
    if (!session_.aboutScene()) {
        place_.fit(session_.about().width(), session_.about().height(), size.pixelWidth, size.pixelHeight);
        if (size.pixelWidth != frameWidth_ || size.pixelHeight != frameHeight_) placed_ = false;
    } else if (session_.stand.width != size.pixelWidth || session_.stand.height != size.pixelHeight) {
        session_.stand.width = size.pixelWidth;
        session_.stand.height = size.pixelHeight;
        settled_ = false;
    }
    frameWidth_ = size.pixelWidth;
    frameHeight_ = size.pixelHeight;
}

void Viewer::takeSamples() {
    const SceneSubject* scene = session_.aboutScene();
    const int final = scene ? scene->finalSamples() : 1;
    const bool moving = held_[0] || held_[1] || held_[2] || flying_;
    constexpr int refine = 4;  // times as many samples in each idle frame
    int wanted = std::min(final, settled_ ? final : samples_ * refine);
    if (moving && !settled_)
        wanted = 1;
    else if (session_.paints())  // first those that are being made
        wanted = samples_;
    if (scene && wanted != session_.stand.samples.value_or(final)) session_.stand.samples = wanted;
    samples_ = wanted;
}

void Viewer::takeNews() {
    const News news = session_.take();
    if (news.picture) {
        placed_ = false;
        panels_.meter.reset();
    }
    if (news.opened) settled_ = false;
    if (news.opened || !news.problem.empty()) panels_.message = news.problem;
    if (!news.remark.empty()) panels_.remark = news.remark;
}

void Viewer::findClicked() {
    if (!clicked_ || session_.paints()) return;
    const auto [x, y] = *std::exchange(clicked_, std::nullopt);
    if (SceneSubject* scene = session_.scene()) panels_.selected = scene->hitAt(x, y);
}

void Viewer::uploadPictures(const FaceSize& size) {
    if (session_.begin()) {
        placed_ = false;
        panels_.meter.reset();
    }
    if (placed_) return;
    const Painting& shown = session_.painting();
    const auto upload = [&](GLuint texture, const Codes& pixels) {
        if (pixels.empty()) return;
        if (session_.aboutScene()) {
            canvas_.upload(texture, shown.width, shown.height, pixels.data());
        } else {
            place_.compose(pixels, composed_);
            canvas_.upload(texture, size.pixelWidth, size.pixelHeight, composed_.data());
        }
    };
    upload(left_, shown.left);
    upload(right_, shown.right);
    placed_ = true;
}

void Viewer::frame(double seconds) {
    const Stopwatch clock;
    // While something is being made, whoever waits for it is told soon.
    constexpr double soon = 1.0 / 60;  // s
    const bool idle = queue_.empty() && settled_;
    const bool busy = session_.paints() || session_.saves();
    for (const Event& event : face_.events(idle ? (busy ? std::min(seconds, soon) : seconds) : 0))
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
    takeNews();
    const FaceSize size = face_.size();
    if (size.pixelWidth < 1 || size.pixelHeight < 1) {  // minimised: nothing to draw into
        settled_ = true;
        return;
    }
    resizePicture(size);
    fly();
    takeSamples();
    try {
        findClicked();
        uploadPictures(size);
    } catch (const InputError& error) {
        panels_.message = error.what();
    } catch (const UsageError& error) {
        panels_.message = error.what();
    }
    settled_ = samples_ >= (session_.aboutScene() ? session_.aboutScene()->finalSamples() : 1) &&
               session_.settled() && !clicked_;
    panels_.samples = session_.aboutScene() ? samples_ : 0;
    draw(size);
    face_.present();
    writeWanted();
    panels_.frameSeconds = clock.seconds();
}

void Viewer::drawPictures(const FaceSize& size) {
    canvas_.begin(size.pixelWidth, size.pixelHeight);
    const bool zebra = session_.gamutWarning && session_.mode != Mode::difference;
    const int width = size.pixelWidth, height = size.pixelHeight;
    if (session_.painting().left.empty()) return;  // the first is being made
    if (session_.mode == Mode::split && !session_.painting().right.empty()) {
        const int divider = dividerColumn(width);
        canvas_.drawPicture(left_, width, height, 0, divider, zebra);
        canvas_.drawPicture(right_, width, height, divider, width, zebra);
    } else {
        canvas_.drawPicture(left_, width, height, 0, width, zebra);
    }
}

void Viewer::draw(const FaceSize& size) {
    const bool inside = !ImGui::GetIO().WantCaptureMouse;
    const auto [x, y] = pixelUnder(pointerX_, pointerY_);
    const bool overRight =
        session_.mode == Mode::split && frameAt(pointerX_, pointerY_)[0] >= dividerColumn(size.pixelWidth);
    const std::shared_ptr<Still>& still = session_.painting().stills[overRight ? 1 : 0];
    if (panels_.visible && still && inside && !panels_.meter) {
        Pin pin = still->measured(x, y);
        if (!pin.spectrum.empty()) panels_.meter = std::move(pin);
    }
    panels_.busy = session_.busy();
    drawPictures(size);
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
    frame(0);
    while (!settled()) {
        session_.await(1.0 / 60);
        frame(0);
    }
    // Panels that a change has made show it in the next frame.
    frame(0);
    return canvas_.read();
}

void Viewer::finish() {
    do {
        session_.await(1.0 / 60);
        frame(0);
    } while (!closed_ && (!settled() || session_.saves()));
    session_.rethrowFailedSave();
}

}  // namespace spectrad::view
