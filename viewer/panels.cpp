// The panel of the look: lights, materials, observer, adaptation, exposure, comparison.
#include "viewer/panels.h"

#include "base/error.h"
#include "viewer/observers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <imgui_stdlib.h>

namespace spectrad::view {

namespace {

void drawLight(Session& session, PanelState& state, size_t number) {
    Look& look = session.look(session.edited);
    ImGui::PushID(static_cast<int>(number));
    if (ImGui::Checkbox(look.lights[number].name.c_str(), &look.lights[number].on)) session.touch(look);
    std::string chosen = look.lights[number].emitter.spectrum.text;
    if (chooseName("##spectrum", state, state.illuminants, chosen))
        attempt(state, [&] { session.setLightSpectrum(number, chosen); });
    LightSetting& light = look.lights[number];  // after the change, which makes them anew
    // One of a pass's colour has no spectrum by itself.
    if (!light.emitter.texture) {
        std::vector<double> nm, value;
        sampled(light.emitter.spectrum.curve(), nm, value);
        plotSpectrum("##plot", nm, value, ImGui::GetContentRegionAvail().x, 46 * state.scale);
    }
    auto stops = static_cast<float>(std::log2(std::max(light.times, 1e-6)));
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderFloat("##amount", &stops, -6, 6, "%+.2f stops")) {
        light.times = std::exp2(static_cast<double>(stops));
        session.touch(look);
    }
    ImGui::PopID();
}

void drawLights(Session& session, PanelState& state) {
    if (!ImGui::CollapsingHeader("Lights", ImGuiTreeNodeFlags_DefaultOpen)) return;
    if (session.look(session.edited).lights.empty())
        ImGui::TextDisabled(session.aboutScene() ? "the scene has none" : "the cube has its light already");
    for (size_t i = 0; i < session.look(session.edited).lights.size(); ++i)
        drawLight(session, state, i);
}

void drawMaterials(Session& session, PanelState& state) {
    if (!ImGui::CollapsingHeader("Materials", state.selected ? ImGuiTreeNodeFlags_DefaultOpen : 0)) return;
    const std::vector<Material>& materials = session.aboutScene()->scene().materials;
    Look& look = session.look(session.edited);
    for (Index m = 0; m < materials.size(); ++m) {
        const Material& material = materials[m];
        if (material.name.empty()) continue;
        ImGui::PushID(static_cast<int>(m));
        const bool selected = state.selected && state.selected->materialIndex == m;
        if (selected) ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1, 0.85f, 0.4f, 1));
        const bool open =
            ImGui::TreeNodeEx(material.name.c_str(), selected ? ImGuiTreeNodeFlags_DefaultOpen : 0);
        if (selected) ImGui::PopStyleColor();
        if (open) {
            if (material.diffuse && material.diffuse->reflectance) {
                const auto changed = look.reflectances.find(m);
                std::string chosen = changed == look.reflectances.end() ? material.diffuse->reflectance->text
                                                                        : changed->second.text;
                if (chooseName("##reflectance", state, state.reflectances, chosen))
                    attempt(state, [&] { session.setReflectance(m, chosen); });
                const auto now = look.reflectances.find(m);
                const Spectrum& shown =
                    now == look.reflectances.end() ? *material.diffuse->reflectance : now->second;
                std::vector<double> nm, value;
                sampled(shown.curve(), nm, value);
                plotSpectrum("##plot", nm, value, ImGui::GetContentRegionAvail().x, 46 * state.scale);
            }
            const auto roughness = [](const Roughness& r) {
                return r.u == r.v ? fmt::format("{:.3g}", r.u)
                                  : fmt::format("{:.3g} along, {:.3g} across", r.u, r.v);
            };
            if (material.gloss)
                ImGui::TextDisabled("gloss, roughness %s", roughness(material.gloss->roughness).c_str());
            if (material.conductor)
                ImGui::TextDisabled("%s, roughness %s", material.conductor->ior.text.c_str(),
                                    roughness(material.conductor->roughness).c_str());
            if (material.diffuse && material.diffuse->texture)
                ImGui::TextDisabled("texture %s", material.diffuse->texture->source.c_str());
            ImGui::TreePop();
        }
        ImGui::PopID();
    }
}

void drawStatus(Session& session, const PanelState& state, float width, float height) {
    ImGui::SetNextWindowPos({8 * state.scale, height - 8 * state.scale}, ImGuiCond_Always, {0, 1});
    ImGui::Begin("##status", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoInputs);
    std::string line =
        state.samples > 0
            ? fmt::format("{} sample{}", state.samples, state.samples == 1 ? "" : "s")
            : fmt::format("{} x {} pixels, {} bands, {}", session.about().width(), session.about().height(),
                          session.about().wavelengths().size(), name(session.about().kind()));
    if (state.selected)
        line += fmt::format("   {}{}{}", state.selected->node.empty() ? "unnamed node" : state.selected->node,
                            state.selected->material.empty() ? "" : " · ", state.selected->material);
    line += session.edited == 0 ? "   look A" : "   look B";
    line += "   H: keys";
    ImGui::TextUnformatted(line.c_str());
    if (!state.busy.empty()) ImGui::TextColored({0.6f, 0.8f, 1, 1}, "%s", state.busy.c_str());
    if (!state.remark.empty()) ImGui::TextDisabled("%s", state.remark.c_str());
    if (!state.message.empty()) {
        ImGui::PushTextWrapPos(width * 0.6f);
        ImGui::TextColored({1, 0.5f, 0.4f, 1}, "%s", state.message.c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

}  // namespace

bool chooseName(const char* label, PanelState& state, const std::vector<std::string>& names,
                std::string& chosen, const char* hint) {
    bool done = false;
    ImGui::SetNextItemWidth(-1);
    if (!ImGui::BeginCombo(label, chosen.c_str(), ImGuiComboFlags_HeightLarge)) return false;
    if (ImGui::IsWindowAppearing()) {
        state.filter.clear();
        ImGui::SetKeyboardFocusHere();
    }
    ImGui::SetNextItemWidth(-1);
    if (ImGui::InputTextWithHint("##filter", hint, &state.filter, ImGuiInputTextFlags_EnterReturnsTrue) &&
        !state.filter.empty()) {
        chosen = state.filter;
        done = true;
        ImGui::CloseCurrentPopup();
    }
    for (const std::string& name : names) {
        if (!state.filter.empty() && name.find(state.filter) == std::string::npos) continue;
        if (ImGui::Selectable(name.c_str(), name == chosen)) {
            chosen = name;
            done = true;
        }
    }
    ImGui::EndCombo();
    return done;
}

void prepare(PanelState& state, Session& session) {
    const std::filesystem::path file = session.about().file();
    // A scene stays beside its files; what a cube gives goes to the current folder.
    state.saveAs =
        ((session.aboutScene() ? file.parent_path() : std::filesystem::path()) / file.stem()).string() +
        "-view";

    for (const LibraryEntry& entry : session.library().list()) {
        if (entry.name.starts_with("illuminants/")) state.illuminants.push_back(entry.name);
        if (entry.quantity == Quantity::reflectance) state.reflectances.push_back(entry.name);
        if (entry.name.starts_with("displays/")) state.displays.push_back(entry.name);
    }
    const SceneSubject* scene = session.aboutScene();
    state.observers = observerNames(session.library(), scene ? &scene->scene() : nullptr);
    state.displays.insert(state.displays.begin(), {"srgb", "p3", "rec2020"});
    const Detector standard = standardObserver(session.library());
    state.locus.emplace(standard);
    constexpr int violet = 390, red = 700, step = 2;
    for (int nm = violet; nm <= red; nm += step) {
        Triple xyz{};
        for (size_t c = 0; c < 3; ++c)
            xyz[c] = standard.response[c].at(nm);
        if (const auto xy = chromaticity(xyz)) state.horseshoe.push_back(*xy);
    }
}

namespace {

/// Over the picture: where pins stand, where A meets B.
void drawMarks(const Session& session, const PanelState& state, float width, float height) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    if (session.mode == Mode::split && session.picture == Picture::observer) {
        const float x = std::round(static_cast<float>(session.divider) * width);
        list.AddLine({x, 0}, {x, height}, IM_COL32(0, 0, 0, 160), 3 * state.scale);
        list.AddLine({x, 0}, {x, height}, IM_COL32(255, 255, 255, 200), state.scale);
    }
    for (size_t i = 0; i < session.pins.size(); ++i) {
        const auto [px, py] = state.frameOf(session.pins[i].x, session.pins[i].y);
        const ImVec2 at{static_cast<float>(px), static_cast<float>(py)};
        list.AddCircle(at, 5 * state.scale, IM_COL32(0, 0, 0, 200), 0, 3 * state.scale);
        list.AddCircle(at, 5 * state.scale, pinColour(i), 0, 1.5f * state.scale);
    }
}

}  // namespace

void drawPanels(Session& session, PanelState& state, float width, float height) {
    if (state.help) drawHelp(width, height);
    if (!state.visible) {
        if (!state.message.empty() || !state.busy.empty()) drawStatus(session, state, width, height);
        return;
    }
    drawMarks(session, state, width, height);
    const float margin = 8 * state.scale, column = 250 * state.scale;
    constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                       ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar;
    // Their background keeps the picture's edges in sight; they end above the line of status.
    ImGui::SetNextWindowPos({width - column - margin, margin});
    ImGui::SetNextWindowSizeConstraints({column, 0}, {column, height - 2 * margin});
    ImGui::Begin("##look", nullptr, fixed | ImGuiWindowFlags_AlwaysAutoResize);
    drawLights(session, state);
    if (session.aboutScene()) drawMaterials(session, state);
    if (session.aboutCube()) drawBands(session);
    drawEye(session, state);
    if (session.picture == Picture::observer) drawComparison(session);
    drawSave(session, state);
    ImGui::End();
    ImGui::SetNextWindowPos({margin, margin});
    ImGui::SetNextWindowSizeConstraints({column, 0}, {column, height - 60 * state.scale});
    ImGui::Begin("##meter", nullptr, fixed | ImGuiWindowFlags_AlwaysAutoResize);
    drawMeter(session, state, column - 16 * state.scale);
    ImGui::End();
    drawStatus(session, state, width, height);
}

}  // namespace spectrad::view
