// The panels over the picture: what they show beside the session, and their drawing with Dear ImGui.
#pragma once

#include "base/error.h"
#include "colour/cct.h"
#include "viewer/session.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace spectrad::view {

/// What a button asked to be written, once the frame is drawn.
struct Wanted {
    enum class What { picture, cube, scene, pins } what = What::picture;
    std::string file;
};

struct PanelState {
    bool visible = true, help = false;
    std::string message;  ///< the last error, one line; empty: none
    std::string remark;   ///< what was done at last, one line
    std::string busy;     ///< what is being done, one line
    std::optional<Wanted> wanted;
    std::string saveAs;              ///< name of files to write, without extension
    std::optional<Hit> selected;     ///< what was clicked
    std::optional<Pin> meter;        ///< under the pointer
    std::uint64_t meterVersion = 0;  ///< of the look that it was measured with
    float scale = 1;                 ///< pixels of the frame per window unit
    int samples = 0;                 ///< a pixel; 0 of a cube
    double frameSeconds = 0;
    std::function<std::array<double, 2>(int, int)>
        frameOf;  ///< where a pixel of the picture lies in the frame

    std::vector<std::string> illuminants, reflectances, observers,
        displays;        ///< names of the library
    std::string filter;  ///< typed into a list's field
    std::optional<PlanckianLocus> locus;
    std::vector<std::array<double, 2>> horseshoe;  ///< x, y of the spectral locus, CIE 1931
};

void prepare(PanelState& state, Session& session);
/// All panels; `message` takes what a change of theirs could not do.
void drawPanels(Session& session, PanelState& state, float width, float height);

/// A spectrum over nm, drawn in the colours of its wavelengths.
void plotSpectrum(const char* id, const std::vector<double>& nm, const std::vector<double>& value,
                  float width, float height);
/// Samples for a plot of a curve; lines show as peaks.
void sampled(const Curve& curve, std::vector<double>& nm, std::vector<double>& value);
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
    } catch (const MachineError& error) {  // a file that cannot be written
        state.message = error.what();
    }
}
/// A list of names with a field to type into: what is typed filters the list, Enter takes it as it stands.
bool chooseName(const char* label, PanelState& state, const std::vector<std::string>& names,
                std::string& chosen, const char* hint = "name, file, blackbody:2856 …");
/// 0xAABBGGRR, as Dear ImGui packs it.
[[nodiscard]] std::uint32_t pinColour(size_t number);
void drawEye(Session& session, PanelState& state);
void drawBands(Session& session);
void drawComparison(Session& session);
void drawSave(Session& session, PanelState& state);
void drawMeter(Session& session, PanelState& state, float width);
void drawHelp(float width, float height);

}  // namespace spectrad::view
