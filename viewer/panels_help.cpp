// The overlay of keys.
#include "viewer/panels.h"

#include <array>
#include <imgui.h>
#include <utility>

namespace spectrad::view {

void drawHelp(float width, float height) {
    static constexpr std::array<std::pair<const char*, const char*>, 20> keys{
        {{"left drag", "orbit about the middle of the view; a cube: move it"},
         {"middle drag, shift + left drag", "pan"},
         {"wheel, right drag", "nearer, farther"},
         {"W A S D, arrows, page up and down", "fly"},
         {"click", "select a node and its material"},
         {"F", "frame what is selected, else everything"},
         {"home", "the scene's own camera; a cube: all of it"},
         {"ctrl + 1 … 9", "keep this view"},
         {"1 … 9", "go to a view kept"},
         {"L", "next illuminant for the first light"},
         {"X", "change the other look, A or B"},
         {"C", "look A, A | B, colour difference, mixture"},
         {"[ ] or - =", "exposure by a quarter of a stop"},
         {"E", "exposure measured from the picture"},
         {"G", "stripes where the display cannot show a colour"},
         {"P", "pin the place under the pointer"},
         {"tab", "panels away, panels back"},
         {"H, F1", "these keys"},
         {"escape", "away with this, and with an error's text; stop writing a cube"},
         {"Q", "close"}}};
    ImGui::SetNextWindowPos({width / 2, height / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowFocus();
    ImGui::SetNextWindowBgAlpha(0.97f);
    ImGui::Begin("##help", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize);
    if (ImGui::BeginTable("##keys", 2)) {
        for (const auto& [key, does] : keys) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", key);
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(does);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

}  // namespace spectrad::view
