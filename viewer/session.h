// The viewer without its window: what is shown and how, and everything that can be done to it by word.
#pragma once

#include "colour/difference.h"
#include "viewer/scene_subject.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace spectrad::view {

enum class Mode {
    single,      ///< look A
    split,       ///< A left of the divider, B right of it
    difference,  ///< ΔE00 between A and B, as false colours
    mixture      ///< lights part A's, part B's
};

/// A place that stays, with what was measured there.
struct Pin {
    int x = 0, y = 0;
    std::vector<double> spectrum;
    Triple xyz{};
};

class Session {
  public:
    Session(std::unique_ptr<SceneSubject> scene, const Library& library, Notes& notes);

    [[nodiscard]] SceneSubject& scene() { return *scene_; }
    [[nodiscard]] Subject& subject() { return *scene_; }
    [[nodiscard]] const Library& library() const { return library_; }
    [[nodiscard]] Look& look(int which) { return looks_.at(static_cast<size_t>(which)); }

    /// "lamp.spectrum=illuminants/A", "lamp.times=0.5", "lamp.on=false", "ink.reflectance=constant:0.5",
    /// "observer=cie1964-10", "adapt=cat16", "white=illuminants/D50" (empty: the first light),
    /// "exposure=1", "exposure=auto", "display=p3", "mode=split", "divider=0.5", "mix=0.3", "look=B" (which
    /// of the two is changed from now on), "gamut=on". Throws UsageError, InputError; then nothing has
    /// changed.
    void set(const std::string& assignment);
    void setLightSpectrum(size_t light, const std::string& spectrum);
    void setReflectance(Index material, const std::string& spectrum);
    void touch(Look& look) { look.version = ++versions_; }

    /// The luminance, cd/m², that is shown as display white before ± EV, from the picture as observe does.
    void autoExpose();
    [[nodiscard]] DevelopSettings settings(const Look& look);
    /// Absolute XYZ to signals for a look.
    [[nodiscard]] Shown shown(const Look& look);
    [[nodiscard]] White whiteOf(const Look& look);

    /// Draws the picture into `left` (and in a split `right`, else left empty); true if either is new.
    bool refresh(std::vector<std::uint32_t>& left, std::vector<std::uint32_t>& right);
    /// Something that refresh() cannot see has changed: the camera, the size, the samples.
    void invalidate() { ++changes_; }

    [[nodiscard]] Pin measured(int x, int y, const Look& look);
    /// CSV of the pins, as `spectrad measure` prints it.
    [[nodiscard]] std::string pinsAsCsv() const;

    int edited = 0;  ///< the look that set() changes
    Mode mode = Mode::single;
    double divider = 0.5, mix = 0.5;
    Adaptation adaptation = Adaptation::cat16;
    std::string white;  ///< as observe --white takes it; empty: the look's first light
    Display display = srgbDisplay();
    std::optional<double> heldLuminance;  ///< nothing: to be measured
    double ev = 0;
    bool gamutWarning = false;
    double differenceTop = 10;                   ///< ΔE00 drawn in the last colour
    std::optional<ColourDifference> difference;  ///< of the last map drawn, without the map itself
    std::vector<Pin> pins;

  private:
    void setOfLook(Look& look, const std::string& name, const std::string& attribute,
                   const std::string& value);
    [[nodiscard]] Shown mixedShown();

    std::unique_ptr<SceneSubject> scene_;
    const Library& library_;
    SpectrumResolver resolver_;
    Detector standard_;
    std::array<Look, 2> looks_;
    std::uint64_t versions_ = 0, changes_ = 1;
    std::string shownState_;
};

}  // namespace spectrad::view
