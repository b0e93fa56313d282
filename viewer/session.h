// The viewer without its window: what is shown and how, and everything that can be done to it by word.
#pragma once

#include "colour/difference.h"
#include "colour/spectral_display.h"
#include "viewer/cube_subject.h"
#include "viewer/scene_subject.h"
#include "viewer/watched_files.h"

#include <array>
#include <functional>
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

/// What a cube shows: colours, or its bands as they are.
enum class Picture { observer, band, falseColour };

/// Opens what is looked at, and opens it again when its files have changed.
using Opener = std::function<std::unique_ptr<Subject>()>;

/// A place that stays, with what was measured there.
struct Pin {
    int x = 0, y = 0;
    std::vector<double> spectrum;
    Triple xyz{};
};

class Session {
  public:
    /// `restricted`: no file outside the subject's folder but the library's.
    Session(Opener open, const Library& library, Notes& notes, bool restricted = false);

    /// Nothing where a cube is shown, and the other way round.
    [[nodiscard]] SceneSubject* scene() { return dynamic_cast<SceneSubject*>(subject_.get()); }
    [[nodiscard]] const SceneSubject* scene() const {
        return dynamic_cast<const SceneSubject*>(subject_.get());
    }
    [[nodiscard]] CubeSubject* cube() { return dynamic_cast<CubeSubject*>(subject_.get()); }
    [[nodiscard]] Subject& subject() { return *subject_; }
    [[nodiscard]] const Library& library() const { return library_; }
    [[nodiscard]] Look& look(int which) { return looks_.at(static_cast<size_t>(which)); }

    /// Opens the subject anew if one of its files has changed on disk; true if so. What was changed here
    /// stays where the files say of it what they said before. If the new one cannot be opened, `problem` says
    /// why and the old one stays.
    bool reload();

    /// "lamp.spectrum=illuminants/A", "lamp.times=0.5", "lamp.on=false", "ink.reflectance=constant:0.5",
    /// "observer=cie1964-10", "adapt=cat16", "white=illuminants/D50" (empty: the first light),
    /// "exposure=1", "exposure=auto", "display=p3", "tone=reinhard", "degree=0.8", "mapping=desaturate",
    /// "mode=split", "divider=0.5", "mix=0.3", "look=B" (which of the two is changed from now on),
    /// "gamut=on"; of a cube "picture=band", "band=550", "bands=650,550,450". Throws UsageError, InputError;
    /// then nothing has changed.
    void set(const std::string& assignment);
    void setLightSpectrum(size_t light, const std::string& spectrum);
    void setReflectance(Index material, const std::string& spectrum);
    void touch(Look& look) { look.version = ++versions_; }

    /// The luminance, cd/m², that is shown as display white before ± EV, from the picture as observe does.
    void autoExpose();
    [[nodiscard]] Rendering rendering(const Look& look);
    /// The display as the look's eye sees it.
    [[nodiscard]] Display displayFor(const Look& look) const;
    /// Absolute XYZ to signals for a look.
    [[nodiscard]] Shown shown(const Look& look);
    [[nodiscard]] White whiteOf(const Look& look);

    /// Draws the picture into `left` (and in a split `right`, else left empty); true if either is new.
    bool refresh(Codes& left, Codes& right);
    /// Something that refresh() cannot see has changed: the camera, the size, the samples.
    void invalidate() { ++changes_; }

    [[nodiscard]] Pin measured(int x, int y, const Look& look);
    /// CSV of the pins, as `spectrad measure` prints it.
    [[nodiscard]] std::string pinsAsCsv();

    /// Scenes only, else UsageError: with the look that is edited, where a file is named (viewer/save.h).
    void saveScene(const std::filesystem::path& target);
    void saveCube(const std::filesystem::path& target);

    std::string software = "Spectrad";  ///< what files say that made them
    int edited = 0;                     ///< the look that set() changes
    Mode mode = Mode::single;
    double divider = 0.5, mix = 0.5;
    Adaptation adaptation = Adaptation::cat16;
    std::string white;                    ///< as observe --white takes it; empty: the look's first light
    std::string display = "srgb";         ///< as observe --display takes it
    std::optional<double> heldLuminance;  ///< nothing: to be measured
    double ev = 0, degree = 1;
    Tone tone = Tone::linear;
    GamutMapping mapping = GamutMapping::clip;
    bool gamutWarning = false;
    Picture picture = Picture::observer;
    BandPicture bands;          ///< of a cube: its band is the first of them while one is shown
    std::string problem;        ///< what the last reload() failed of; empty: nothing
    double differenceTop = 10;  ///< ΔE00 drawn in the last colour
    std::optional<ColourDifference> difference;  ///< of the last map drawn, without the map itself
    std::vector<Pin> pins;

  private:
    void setOfLook(Look& look, const std::string& name, const std::string& attribute,
                   const std::string& value);
    void setPicture(const std::string& name, const std::string& value);
    void setDisplay(const std::string& text);
    void setWhite(const std::string& text);
    [[nodiscard]] Shown shownBy(const Rendering& how);
    [[nodiscard]] Rendering mixedRendering();
    void drawDifference(Codes& codes);
    /// All that the picture was made of, spectra chosen here included.
    [[nodiscard]] std::vector<std::filesystem::path> files() const;
    /// What of a look outlives the opening of other files.
    [[nodiscard]] Look carried(const Look& old, const Subject& fresh) const;

    Opener open_;
    std::unique_ptr<Subject> subject_;
    const Library& library_;
    Notes& notes_;
    SpectrumResolver resolver_;
    Detector standard_;
    Display display_ = srgbDisplay();
    std::optional<SpectralDisplay> spectralDisplay_;  ///< a display by its primaries, as each eye sees it
    bool automatic_ = false;                          ///< exposure from the picture whatever the white
    std::array<Look, 2> looks_;
    WatchedFiles watched_;
    std::uint64_t versions_ = 0, changes_ = 1;
    std::string shownState_;
};

}  // namespace spectrad::view
