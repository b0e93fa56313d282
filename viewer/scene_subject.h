// A scene on a device: the term image stays there, a look costs three floats a term.
#pragma once

#include "render/light_groups.h"
#include "render/live.h"
#include "render/passes.h"
#include "scene/load.h"
#include "viewer/subject.h"

#include <optional>
#include <set>

namespace spectrad::view {

/// What a pixel sees.
struct Hit {
    std::string node, material;  ///< names; empty where the scene gives none
    Index materialIndex = 0;
    Vec3 place;  ///< in the world, metres
};

class SceneSubject : public Subject {
  public:
    /// Throws InputError, UsageError, MachineError as loading and planning do.
    SceneSubject(const std::filesystem::path& file, const LoadOptions& load, const RenderSettings& settings,
                 const Device& device, const Library& library, Notes& notes);

    [[nodiscard]] const Scene& scene() const { return scene_; }
    /// As it was opened.
    [[nodiscard]] const LoadOptions& loadOptions() const { return load_; }
    [[nodiscard]] const RenderSettings& settings() const { return settings_; }
    [[nodiscard]] const Device& device() const { return device_; }
    /// The scene as it is looked at: lights, reflectances, and the camera where it stands.
    [[nodiscard]] Scene changed(const Look& look, const Stand& stand) const;
    /// A camera that stands elsewhere than the scene's own, in the space of its node.
    struct Moved {
        Index camera = 0;
        Vec3 eye, target, up;   ///< metres
        double viewHeight = 1;  ///< orthographic, metres
    };
    [[nodiscard]] std::optional<Moved> moved(const Pose& pose) const;
    /// Where the scene's own camera stands.
    [[nodiscard]] const Pose& home() const { return home_; }
    [[nodiscard]] int finalSamples() const { return finalSamples_; }
    /// Middle and radius of everything there is, metres.
    [[nodiscard]] const std::pair<Vec3, double>& bounds() const { return bounds_; }

    [[nodiscard]] std::filesystem::path file() const override { return scene_.file; }
    [[nodiscard]] std::vector<std::filesystem::path> files() const override {
        return {scene_.filesRead.begin(), scene_.filesRead.end()};
    }
    [[nodiscard]] Look firstLook() const override;
    [[nodiscard]] int width() const override { return width_; }
    [[nodiscard]] int height() const override { return height_; }
    [[nodiscard]] const Wavelengths& wavelengths() const override { return wavelengths_; }
    [[nodiscard]] CubeKind kind() const override { return CubeKind::radiance; }

    [[nodiscard]] const Plan& plan() { return live_->plan(); }
    /// How often the materials were planned anew: what a change costs beyond its terms' colours.
    [[nodiscard]] int timesPlanned() { return timesPlanned_; }
    [[nodiscard]] std::optional<Hit> hitAt(int x, int y);

    void stand(const Stand& stand) override;
    void show(const Look& look, const Shown& shown, Codes& codes) override;
    void showMixed(const Look& a, const Look& b, double mix, const Shown& shown, Codes& codes) override;
    [[nodiscard]] ChannelImage xyz(const Look& look) override;
    [[nodiscard]] std::shared_ptr<Still> still(const Look& look) override;
    [[nodiscard]] White white(const Look& look) override;
    [[nodiscard]] double whiteAmount(const Look& look) override;

  private:
    /// Terms under one look.
    struct Table {
        std::uint64_t version = 0;
        std::map<Index, std::string> reflectances;  ///< by their texts
        std::vector<double> amounts;                ///< of the lights, times their own
        std::vector<std::string> lamps;             ///< their spectra, by their texts
        std::vector<LightGroup> groups;
        std::vector<TermRecipe> recipes;
        std::vector<float> spectra;  ///< of a plan's bands, for terms whose recipe is unknown
        std::vector<float> colours;
        std::shared_ptr<const Eye> eye;
    };
    class SceneStill;
    [[nodiscard]] std::shared_ptr<const Table> table(const Look& look);
    [[nodiscard]] Scene sceneOf(const Look& look) const;
    void placeCamera(Scene& scene, const Stand& stand) const;
    void measureBounds();
    /// Whether a picture depends on the camera's place beyond perspective: curved shapes are cut into
    /// triangles as it sees them, mirrors and a backdrop show what was rendered for it.
    [[nodiscard]] bool followsCamera() const;
    /// The scene as it is planned: lights that must change without the others are in groups of their own.
    [[nodiscard]] Scene grouped(const Look& look);
    [[nodiscard]] bool apart();
    [[nodiscard]] std::vector<LightGroup> groupsOf(const Scene& scene, const ResolveEmitter& resolved);
    /// All terms anew, materials included.
    void plan(Table& table, const Look& look, const Scene& changed);
    void resolve();
    /// For the last samples of a camera that has moved: what depends on where it stands is made anew.
    void follow();
    void showColours(const std::vector<float>& colours, const Shown& shown, Codes& codes);

    [[nodiscard]] int samples() { return stand_.samples.value_or(finalSamples_); }

    // Of its opening:
    const Library& library_;
    Device device_, reader_;  ///< with a queue each: the holder's, and the stills'
    LoadOptions load_;
    RenderSettings settings_;
    Scene scene_;
    FlatScene flat_;
    Wavelengths wavelengths_;
    Index camera_ = 0;   ///< whose picture it is
    Affine cameraNode_;  ///< that camera's node to the world
    Pose home_;
    Affine homeView_;  ///< the world to it, exactly as it was planned
    std::pair<Vec3, double> bounds_;
    int width_ = 0, height_ = 0, finalSamples_ = 16;
    bool passes_ = false;    ///< others than the one that is shown, which depend on the lights' amounts
    bool pictures_ = false;  ///< among them such as depend on the lights' spectra
    bool follows_ = false;   ///< shapes cut, or pictures made, as the camera sees them

    // The holder's:
    std::unique_ptr<LiveImage> live_;
    std::set<size_t> apart_;                            ///< of many lights those that have been changed
    std::vector<std::shared_ptr<const Table>> tables_;  ///< the last few looks'
    View view_;
    Stand stand_;
    bool stale_ = false;  ///< made for another place or size than the view's
    int timesPlanned_ = 0;
};

}  // namespace spectrad::view
