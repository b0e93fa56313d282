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
        return session_.scene() ? std::array<double, 2>{x + 0.5, y + 0.5} : place_.frameOf(x, y);
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
    if (session_.scene()) return {column, row};
    return place_.pixelAt(column, row);
}

int Viewer::dividerColumn(int frameWidth) const {
    return static_cast<int>(std::lround(session_.divider * frameWidth));
}

void Viewer::resizePicture(const FaceSize& size) {
    SceneSubject* scene = session_.scene();
    if (!scene) {
        place_.fit(session_.subject().width(), session_.subject().height(), size.pixelWidth,
                   size.pixelHeight);
        if (size.pixelWidth != frameWidth_ || size.pixelHeight != frameHeight_) placed_ = false;
    } else if (scene->width() != size.pixelWidth || scene->height() != size.pixelHeight) {
        scene->setSize(size.pixelWidth, size.pixelHeight);
        session_.invalidate();
        settled_ = false;
    }
    frameWidth_ = size.pixelWidth;
    frameHeight_ = size.pixelHeight;
}

void Viewer::takeSamples() {
    SceneSubject* scene = session_.scene();
    const int final = scene ? scene->finalSamples() : 1;
    const bool moving = held_[0] || held_[1] || held_[2];
    constexpr int refine = 4;  // times as many samples in each idle frame
    const int wanted = moving && !settled_ ? 1 : std::min(final, settled_ ? final : samples_ * refine);
    if (scene && wanted != scene->samples()) {
        scene->setSamples(wanted);
        session_.invalidate();
    }
    samples_ = wanted;
}

void Viewer::uploadPictures(const FaceSize& size) {
    if (session_.refresh(leftPixels_, rightPixels_)) {
        placed_ = false;
        panels_.meter.reset();
    }
    if (placed_) return;
    const auto upload = [&](GLuint texture, const Codes& pixels) {
        if (pixels.empty()) return;
        if (!session_.scene()) place_.compose(pixels, composed_);
        canvas_.upload(texture, size.pixelWidth, size.pixelHeight,
                       session_.scene() ? pixels.data() : composed_.data());
    };
    upload(left_, leftPixels_);
    upload(right_, rightPixels_);
    placed_ = true;
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
    if (session_.reload()) {
        panels_.message = session_.problem;
        settled_ = false;
    }
    const FaceSize size = face_.size();
    if (size.pixelWidth < 1 || size.pixelHeight < 1) {  // minimised: nothing to draw into
        settled_ = true;
        return;
    }
    resizePicture(size);
    fly();
    takeSamples();
    try {
        uploadPictures(size);
    } catch (const InputError& error) {
        panels_.message = error.what();
    } catch (const UsageError& error) {
        panels_.message = error.what();
    }
    settled_ = samples_ >= (session_.scene() ? session_.scene()->finalSamples() : 1);
    panels_.samples = session_.scene() ? samples_ : 0;
    draw(size);
    face_.present();
    writeWanted();
    panels_.frameSeconds = clock.seconds();
}

void Viewer::drawPictures(const FaceSize& size) {
    canvas_.begin(size.pixelWidth, size.pixelHeight);
    const bool zebra = session_.gamutWarning && session_.mode != Mode::difference;
    const int width = size.pixelWidth, height = size.pixelHeight;
    if (session_.mode == Mode::split && !rightPixels_.empty()) {
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
    if (panels_.visible && settled_ && inside && !panels_.meter) {
        Pin pin = session_.measured(x, y, session_.look(overRight ? 1 : 0));
        if (!pin.spectrum.empty()) panels_.meter = std::move(pin);
    }
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
    do
        frame(0);
    while (!settled());
    // Panels that a change has made show it in the next frame.
    frame(0);
    return canvas_.read();
}

}  // namespace spectrad::view
