// The panels over the picture: what they show beside the session, and their drawing with Dear ImGui.
#pragma once

#include "colour/cct.h"
#include "viewer/session.h"

#include <optional>
#include <string>
#include <vector>

namespace spectrad::view {

struct PanelState {
    bool visible = true, help = false;
    std::string message;             ///< the last error, one line; empty: none
    std::optional<Hit> selected;     ///< what was clicked
    std::optional<Pin> meter;        ///< under the pointer
    std::uint64_t meterVersion = 0;  ///< of the look that it was measured with
    float scale = 1;                 ///< pixels of the frame per window unit
    int samples = 0;
    double frameSeconds = 0;

    std::vector<std::string> illuminants, reflectances, observers;  ///< names of the library
    std::string filter;                                             ///< typed into a list's field
    std::optional<PlanckianLocus> locus;
    std::vector<std::array<double, 2>> horseshoe;  ///< x, y of the spectral locus, CIE 1931
};

void prepare(PanelState& state, const Session& session);
/// All panels; `message` takes what a change of theirs could not do.
void drawPanels(Session& session, PanelState& state, float width, float height);

/// A spectrum over nm, drawn in the colours of its wavelengths.
void plotSpectrum(const char* id, const std::vector<double>& nm, const std::vector<double>& value,
                  float width, float height);
/// Samples for a plot of a curve; lines show as peaks.
void sampled(const Curve& curve, std::vector<double>& nm, std::vector<double>& value);
void drawMeter(Session& session, PanelState& state, float width);
void drawHelp(float width, float height);

}  // namespace spectrad::view
