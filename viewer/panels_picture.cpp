// How the picture is made for the display: eye, adaptation, exposure; the bands of a cube; comparison.
#include "viewer/panels.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <imgui.h>
#include <imgui_stdlib.h>

namespace spectrad::view {

namespace {

template <size_t Count>
bool chooseOne(const char* label, const std::array<const char*, Count>& names, int& chosen) {
    ImGui::SetNextItemWidth(-1);
    return ImGui::Combo(label, &chosen, names.data(), static_cast<int>(Count));
}

void drawAdaptation(Session& session, PanelState& state) {
    ImGui::TextDisabled("adaptation to the white");
    static constexpr std::array<const char*, 4> adaptations{"cat16", "bradford", "vonkries", "none"};
    int adaptation = static_cast<int>(session.adaptation);
    if (chooseOne("##adapt", adaptations, adaptation))
        attempt(state,
                [&] { session.set(std::string("adapt=") + adaptations[static_cast<size_t>(adaptation)]); });
    auto degree = static_cast<float>(session.degree);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderFloat("##degree", &degree, 0, 1, "degree %.2f"))
        session.degree = static_cast<double>(degree);
    std::string white = session.white.empty() ? "the first light" : session.white;
    if (chooseName("##white", state, state.illuminants, white))
        attempt(state, [&] { session.set("white=" + white); });
    if (!session.white.empty() && ImGui::SmallButton("white: the first light again"))
        attempt(state, [&] { session.set("white="); });
}

void drawExposure(Session& session, PanelState& state) {
    auto ev = static_cast<float>(session.ev);
    ImGui::SetNextItemWidth(-70 * state.scale);
    if (ImGui::SliderFloat("##ev", &ev, -6, 6, "%+.2f EV")) session.ev = static_cast<double>(ev);
    ImGui::SameLine();
    if (ImGui::Button("auto", {-1, 0})) attempt(state, [&] { session.set("exposure=auto"); });
    const bool bands = session.picture != Picture::observer;
    if (bands)
        ImGui::TextDisabled("%.4g %s shown as white", session.bands.white[0],
                            std::string(unit(session.about().kind())).c_str());
    else if (session.look(session.edited).film)
        ImGui::TextDisabled("of the film; its meter sets the rest");
    else if (session.heldLuminance)
        ImGui::TextDisabled("%.4g cd/m² shown as white", *session.heldLuminance * std::exp2(-session.ev));
}

}  // namespace

void drawEye(Session& session, PanelState& state) {
    if (!ImGui::CollapsingHeader("Eye and display", ImGuiTreeNodeFlags_DefaultOpen)) return;
    std::string observer = session.look(session.edited).eye->detector.name;
    ImGui::TextDisabled("observer");
    if (chooseName("##observer", state, state.observers, observer, "name, file, qe:… * …"))
        attempt(state, [&] { session.set("observer=" + observer); });
    drawAdaptation(session, state);
    ImGui::TextDisabled("display");
    std::string display = session.display;
    if (chooseName("##display", state, state.displays, display, "name, file of primaries"))
        attempt(state, [&] { session.set("display=" + display); });
    bool bends = session.tone == Tone::reinhard;
    if (ImGui::Checkbox("tone curve (Reinhard)", &bends))
        session.tone = bends ? Tone::reinhard : Tone::linear;
    bool greys = session.mapping == GamutMapping::desaturate;
    if (ImGui::Checkbox("desaturate what is out of gamut", &greys))
        session.mapping = greys ? GamutMapping::desaturate : GamutMapping::clip;
    ImGui::Checkbox("stripe what is out of gamut", &session.gamutWarning);
    drawExposure(session, state);
}

void drawBands(Session& session) {
    if (!ImGui::CollapsingHeader("Bands", ImGuiTreeNodeFlags_DefaultOpen)) return;
    static constexpr std::array<const char*, 3> pictures{"what the observer sees", "one band, grey",
                                                         "three bands, false colours"};
    int picture = static_cast<int>(session.picture);
    if (chooseOne("##picture", pictures, picture)) session.picture = static_cast<Picture>(picture);
    if (session.picture == Picture::observer) return;
    const std::vector<double>& nm = session.about().wavelengths().nm;
    const auto slider = [&](const char* label, size_t& band, const char* prefix) {
        int number = static_cast<int>(band);
        // The text of a slider is a format: it shows the wavelength instead of the number.
        const std::string text = fmt::format("{}{:.6g} nm", prefix, nm[band]);
        ImGui::SetNextItemWidth(-1);
        if (ImGui::SliderInt(label, &number, 0, static_cast<int>(nm.size()) - 1, text.c_str(),
                             ImGuiSliderFlags_AlwaysClamp))
            band = static_cast<size_t>(number);
    };
    if (session.picture == Picture::band) {
        slider("##band", session.bands.bands[0], "");
    } else {
        slider("##red", session.bands.bands[0], "red: ");
        slider("##green", session.bands.bands[1], "green: ");
        slider("##blue", session.bands.bands[2], "blue: ");
    }
}

void drawComparison(Session& session) {
    if (!ImGui::CollapsingHeader("Compare", ImGuiTreeNodeFlags_DefaultOpen)) return;
    static constexpr std::array<const char*, 4> modes{"look A alone", "A | B, divided",
                                                      "colour difference of A, B", "light mixed of A and B"};
    int mode = static_cast<int>(session.mode);
    if (chooseOne("##mode", modes, mode)) session.mode = static_cast<Mode>(mode);
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("panels change");
    ImGui::SameLine();
    ImGui::RadioButton("A", &session.edited, 0);
    ImGui::SameLine();
    ImGui::RadioButton("B", &session.edited, 1);
    if (session.mode == Mode::mixture) {
        auto mix = static_cast<float>(session.mix);
        ImGui::SetNextItemWidth(-1);
        if (ImGui::SliderFloat("##mix", &mix, 0, 1, "A … B  %.2f")) session.mix = static_cast<double>(mix);
    }
    if (session.mode == Mode::difference) {
        auto top = static_cast<float>(session.differenceTop);
        ImGui::SetNextItemWidth(-1);
        if (ImGui::SliderFloat("##top", &top, 0.5f, 40, "yellow from ΔE %.1f"))
            session.differenceTop = static_cast<double>(top);
        if (session.painting().difference)
            ImGui::Text("ΔE00 mean %.2f  95%% %.2f  max %.2f", session.painting().difference->mean,
                        session.painting().difference->p95, session.painting().difference->max);
    }
}

void drawSave(Session& session, PanelState& state) {
    if (!ImGui::CollapsingHeader("Save")) return;
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##name", "name, without extension", &state.saveAs);
    const auto button = [&](const char* label, Wanted::What what, const char* extension) {
        if (ImGui::Button(label) && !state.saveAs.empty()) state.wanted = {what, state.saveAs + extension};
    };
    button("picture", Wanted::What::picture, ".png");
    if (session.aboutScene()) {
        ImGui::SameLine();
        button("cube", Wanted::What::cube, ".exr");
        ImGui::SameLine();
        button("scene", Wanted::What::scene, ".xml");
    }
    ImGui::SameLine();
    button("pins", Wanted::What::pins, ".csv");
}

}  // namespace spectrad::view
