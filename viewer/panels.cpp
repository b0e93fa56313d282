// The panel of the look: lights, materials, observer, adaptation, exposure, comparison.
#include "viewer/panels.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <imgui_stdlib.h>

namespace spectrad::view {

namespace {

/// Runs a change of the user's; what it cannot do is said in the window.
template <typename Call>
void attempt(PanelState& state, Call call) {
    try {
        call();
        state.message.clear();
    } catch (const InputError& error) {
        state.message = error.what();
    } catch (const UsageError& error) {
        state.message = error.what();
    }
}

/// A list of names with a field to type into: what is typed filters the list, Enter takes it as it stands.
bool chooseName(const char* label, PanelState& state, const std::vector<std::string>& names,
                std::string& chosen) {
    bool done = false;
    ImGui::SetNextItemWidth(-1);
    if (!ImGui::BeginCombo(label, chosen.c_str(), ImGuiComboFlags_HeightLarge)) return false;
    if (ImGui::IsWindowAppearing()) {
        state.filter.clear();
        ImGui::SetKeyboardFocusHere();
    }
    ImGui::SetNextItemWidth(-1);
    if (ImGui::InputTextWithHint("##filter", "name, file, blackbody:2856 …", &state.filter,
                                 ImGuiInputTextFlags_EnterReturnsTrue) &&
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

void drawLight(Session& session, PanelState& state, size_t number) {
    Look& look = session.look(session.edited);
    LightSetting& light = look.lights[number];
    ImGui::PushID(static_cast<int>(number));
    if (ImGui::Checkbox(light.name.c_str(), &light.on)) session.touch(look);
    std::string chosen = light.emitter.spectrum.text;
    if (chooseName("##spectrum", state, state.illuminants, chosen))
        attempt(state, [&] { session.setLightSpectrum(number, chosen); });
    std::vector<double> nm, value;
    sampled(look.lights[number].emitter.spectrum.curve(), nm, value);
    plotSpectrum("##plot", nm, value, ImGui::GetContentRegionAvail().x, 46 * state.scale);
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
    if (session.look(session.edited).lights.empty()) ImGui::TextDisabled("the scene has none");
    for (size_t i = 0; i < session.look(session.edited).lights.size(); ++i)
        drawLight(session, state, i);
}

void drawMaterials(Session& session, PanelState& state) {
    if (!ImGui::CollapsingHeader("Materials", state.selected ? ImGuiTreeNodeFlags_DefaultOpen : 0)) return;
    const std::vector<Material>& materials = session.scene().scene().materials;
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

template <size_t Count>
bool chooseOne(const char* label, const std::array<const char*, Count>& names, int& chosen) {
    ImGui::SetNextItemWidth(-1);
    return ImGui::Combo(label, &chosen, names.data(), static_cast<int>(Count));
}

void drawEye(Session& session, PanelState& state) {
    if (!ImGui::CollapsingHeader("Eye and display", ImGuiTreeNodeFlags_DefaultOpen)) return;
    std::string observer = session.look(session.edited).eye->detector.name;
    ImGui::TextDisabled("observer");
    if (chooseName("##observer", state, state.observers, observer))
        attempt(state, [&] { session.set("observer=" + observer); });
    ImGui::TextDisabled("adaptation to the white");
    static constexpr std::array<const char*, 4> adaptations{"cat16", "bradford", "vonkries", "none"};
    int adaptation = static_cast<int>(session.adaptation);
    if (chooseOne("##adapt", adaptations, adaptation))
        attempt(state,
                [&] { session.set(std::string("adapt=") + adaptations[static_cast<size_t>(adaptation)]); });
    std::string white = session.white.empty() ? "the first light" : session.white;
    if (chooseName("##white", state, state.illuminants, white))
        attempt(state, [&] { session.set("white=" + white); });
    if (!session.white.empty() && ImGui::SmallButton("white: the first light again")) session.white.clear();
    ImGui::TextDisabled("display");
    static constexpr std::array<const char*, 3> displays{"srgb", "p3", "rec2020"};
    int display = -1;
    for (size_t i = 0; i < displays.size(); ++i)
        if (session.display.name == displayFor(displays[i]).name) display = static_cast<int>(i);
    if (chooseOne("##display", displays, display))
        attempt(state,
                [&] { session.set(std::string("display=") + displays[static_cast<size_t>(display)]); });
    auto ev = static_cast<float>(session.ev);
    ImGui::SetNextItemWidth(-70 * state.scale);
    if (ImGui::SliderFloat("##ev", &ev, -6, 6, "%+.2f EV")) session.ev = static_cast<double>(ev);
    ImGui::SameLine();
    if (ImGui::Button("auto", {-1, 0})) attempt(state, [&] { session.set("exposure=auto"); });
    if (session.heldLuminance)
        ImGui::TextDisabled("%.4g cd/m² shown as white", *session.heldLuminance * std::exp2(-session.ev));
    ImGui::Checkbox("stripe what is out of gamut", &session.gamutWarning);
}

void drawComparison(Session& session, PanelState& state) {
    if (!ImGui::CollapsingHeader("Compare", ImGuiTreeNodeFlags_DefaultOpen)) return;
    static constexpr std::array<const char*, 4> modes{"look A alone", "A | B, divided",
                                                      "colour difference of A, B", "light mixed of A and B"};
    int mode = static_cast<int>(session.mode);
    if (chooseOne("##mode", modes, mode)) session.mode = static_cast<Mode>(mode);
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
        if (session.difference)
            ImGui::Text("ΔE00 mean %.2f  95%% %.2f  max %.2f", session.difference->mean,
                        session.difference->p95, session.difference->max);
    }
    (void)state;
}

void drawStatus(const Session& session, const PanelState& state, float width, float height) {
    ImGui::SetNextWindowPos({8 * state.scale, height - 8 * state.scale}, ImGuiCond_Always, {0, 1});
    ImGui::Begin("##status", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoInputs);
    std::string line = fmt::format("{} samples", state.samples);
    if (state.selected)
        line += fmt::format("   {}{}{}", state.selected->node.empty() ? "unnamed node" : state.selected->node,
                            state.selected->material.empty() ? "" : " · ", state.selected->material);
    line += session.edited == 0 ? "   look A" : "   look B";
    line += "   H: keys";
    ImGui::TextUnformatted(line.c_str());
    if (!state.message.empty()) {
        ImGui::PushTextWrapPos(width * 0.6f);
        ImGui::TextColored({1, 0.5f, 0.4f, 1}, "%s", state.message.c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

}  // namespace

void prepare(PanelState& state, const Session& session) {
    for (const LibraryEntry& entry : session.library().list()) {
        if (entry.name.starts_with("illuminants/")) state.illuminants.push_back(entry.name);
        if (entry.quantity == Quantity::reflectance) state.reflectances.push_back(entry.name);
        if (entry.quantity == Quantity::sensitivity) state.observers.push_back(entry.name);
    }
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

void drawPanels(Session& session, PanelState& state, float width, float height) {
    if (state.help) drawHelp(width, height);
    if (!state.visible) {
        if (!state.message.empty()) drawStatus(session, state, width, height);
        return;
    }
    const float margin = 8 * state.scale, column = 250 * state.scale;
    constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                       ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar;
    // Their background keeps the picture's edges in sight; they end above the line of status.
    ImGui::SetNextWindowPos({width - column - margin, margin});
    ImGui::SetNextWindowSizeConstraints({column, 0}, {column, height - 2 * margin});
    ImGui::Begin("##look", nullptr, fixed | ImGuiWindowFlags_AlwaysAutoResize);
    drawLights(session, state);
    drawMaterials(session, state);
    drawEye(session, state);
    drawComparison(session, state);
    ImGui::End();
    ImGui::SetNextWindowPos({margin, margin});
    ImGui::SetNextWindowSizeConstraints({column, 0}, {column, height - 60 * state.scale});
    ImGui::Begin("##meter", nullptr, fixed | ImGuiWindowFlags_AlwaysAutoResize);
    drawMeter(session, state, column - 16 * state.scale);
    ImGui::End();
    drawStatus(session, state, width, height);
}

}  // namespace spectrad::view
