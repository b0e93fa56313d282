// The viewer without its window: what is wished for, what is shown, and the jobs in between.
//
// Which thread owns what (docs/design.md, "The viewer"): a session and all it holds belong to the window's
// thread. While a painting is being made its thread has the painter, and subject(), scene(), cube() and
// whiteOf() wait for it; about…() never wait. Saving and opening work on objects of their own.
#pragma once

#include "viewer/cube_subject.h"
#include "viewer/job.h"
#include "viewer/painter.h"
#include "viewer/scene_subject.h"
#include "viewer/watched_files.h"

#include <array>
#include <atomic>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace spectrad::view {

/// Opens what is looked at, and opens it again when its files have changed: on another thread.
using Opener = std::function<std::unique_ptr<Subject>(Notes&)>;

/// What has become of jobs since the last time.
struct News {
    bool picture = false;  ///< there is another one
    bool opened = false;   ///< the files were opened anew, or it was tried
    std::string problem;   ///< one line; empty: none
    std::string remark;    ///< what is done
};

/// A wish that can be changed by word.
class Session : public Wish {
  public:
    /// `restricted`: no file outside the subject's folder but the library's.
    Session(Opener open, const Library& library, Notes& notes, bool restricted = false);

    /// What never changes of the subject. Nothing where a cube is shown, and the other way round.
    [[nodiscard]] const Subject& about() const { return painter_->about(); }
    [[nodiscard]] const SceneSubject* aboutScene() const {
        return dynamic_cast<const SceneSubject*>(&painter_->about());
    }
    [[nodiscard]] const CubeSubject* aboutCube() const {
        return dynamic_cast<const CubeSubject*>(&painter_->about());
    }
    /// The subject itself, looked at as it is wished for; waits for a painting that is being made.
    [[nodiscard]] Subject& subject() { return atHand().subject(); }
    [[nodiscard]] SceneSubject* scene() { return dynamic_cast<SceneSubject*>(&subject()); }
    [[nodiscard]] CubeSubject* cube() { return dynamic_cast<CubeSubject*>(&subject()); }
    [[nodiscard]] White whiteOf(const Look& look) { return atHand().whiteOf(*this, look); }
    /// XYZ of the picture, absolute.
    [[nodiscard]] ChannelImage seen(const Look& look) { return atHand().seen(*this, look); }

    [[nodiscard]] const Library& library() const { return library_; }
    [[nodiscard]] Look& look(int which) { return looks.at(static_cast<size_t>(which)); }
    [[nodiscard]] Display displayFor(const Look& look) const { return Wish::displayFor(look, standard_); }
    /// For CIE 1931, which the chromaticities in files are meant for.
    [[nodiscard]] Display displayForStandard() const {
        return primaries ? primaries->seenBy(standard_) : codes;
    }

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

    /// Takes over what jobs have finished; looks whether files have changed.
    [[nodiscard]] News take();
    /// Sees to it that the wish is painted: at once if `waits` (true: there is another picture; throws what
    /// the painter throws), else by a job, unless one is at work. A job for a wish of the past is stopped.
    bool begin();
    /// The last good picture.
    [[nodiscard]] const Painting& painting() const { return painting_; }
    /// A picture is being made.
    [[nodiscard]] bool paints() const { return paints_.running(); }
    /// The picture is that of the wish, or there is none of it, and no file is being opened.
    [[nodiscard]] bool settled() const;
    /// The next picture is made anew whatever has changed.
    void invalidate() { ++changes_; }
    /// What is being done, and how far it is; empty while that is too short to be told.
    [[nodiscard]] std::string busy() const;
    /// Waits for some job for up to `seconds`.
    void await(double seconds) const;

    /// Opens the subject anew if one of its files has changed on disk, and waits for it; true if so. What was
    /// changed here stays where the files say of it what they said before. If the new one cannot be opened,
    /// `problem` says why and the old one stays.
    bool reload();

    /// Scenes only, else UsageError: with the look that is edited, where a file is named (viewer/save.h).
    void saveScene(const std::filesystem::path& target);
    /// Renders it: at once if `waits`, else by a job. UsageError while another one is being written.
    void saveCube(const std::filesystem::path& target);
    [[nodiscard]] bool saves() const { return saves_.running(); }
    /// Nothing is left of the file then.
    void stopSaving() { saves_.stop(); }
    /// Throws what the last save that failed in a job has thrown.
    void rethrowFailedSave();
    [[nodiscard]] std::string pinsAsCsv() const;

    bool waits = true;                  ///< false: jobs work while frames go on
    std::string software = "Spectrad";  ///< what files say that made them
    int edited = 0;                     ///< the look that set() changes
    double divider = 0.5;               ///< of a split, of its width
    bool gamutWarning = false;
    std::string problem;  ///< what the last reload failed of; empty: nothing
    std::vector<Pin> pins;

  private:
    using Opened = std::unique_ptr<Painter>;
    using Painted = std::shared_ptr<Painting>;

    [[nodiscard]] Painter& atHand();
    /// What cannot be painted is found out before it is kept, if there is time to wait for that.
    void check(const Look& look);
    void setOfLook(Look& look, const std::string& name, const std::string& attribute,
                   const std::string& value);
    void setPicture(const std::string& name, const std::string& value);
    void setDisplay(const std::string& text);
    void setWhite(const std::string& text);
    /// All that the picture was made of, spectra chosen here included.
    [[nodiscard]] std::vector<std::filesystem::path> files() const;
    [[nodiscard]] std::string state(const Wish& wish, std::uint64_t changes) const;
    void takePainting();
    void show(Painting&& painting);
    void takeBack();
    [[nodiscard]] Job<Opened>::Work opening();
    void takeOpened(Opened fresh);

    Opener open_;
    const Library& library_;
    bool restricted_;
    std::unique_ptr<Painter> painter_;
    Notes& notes_;
    SpectrumResolver resolver_;
    Detector standard_;
    WatchedFiles watched_;
    std::uint64_t versions_ = 0, changes_ = 1, changesPainted_ = 0;
    Painting painting_, spare_;
    std::string painted_, beingPainted_, failed_;  ///< states
    bool hasty_ = false;                           ///< what is being painted has one sample a pixel
    News news_;                                    ///< not told yet
    bool changedAgain_ = false;                    ///< a file, while they were being opened
    std::string saving_;                           ///< the file
    std::shared_ptr<std::atomic<double>> saved_ = std::make_shared<std::atomic<double>>(0);  ///< share
    std::exception_ptr failedSave_;

    // Last, so that their threads end before anything that they use.
    Job<Painted> paints_;
    Job<Opened> opens_;
    Job<std::string> saves_;
};

}  // namespace spectrad::view
