// The viewer at work: events move the camera and the panels, frames are drawn, scripts are played. The same
// for a window and off screen.
#pragma once

#include "base/error.h"
#include "viewer/canvas.h"
#include "viewer/panels.h"
#include "viewer/picture_place.h"
#include "viewer/script.h"
#include "viewer/session.h"

#include <array>
#include <deque>
#include <filesystem>
#include <optional>
#include <vector>

struct ImGuiContext;

namespace spectrad::view {

class Viewer {
  public:
    Viewer(Face& face, Session& session);
    ~Viewer();
    Viewer(const Viewer&) = delete;
    Viewer& operator=(const Viewer&) = delete;

    /// One frame: events of the face (waited for up to `seconds`) and of scripts, then drawing.
    void frame(double seconds);
    /// Plays an action to its end, frames included. Throws what the action cannot do.
    void play(const Action& action);
    void showPanels(bool visible) { panels_.visible = visible; }
    [[nodiscard]] bool closed() const { return closed_; }
    /// Nothing moves, and the picture has all its samples.
    [[nodiscard]] bool settled() const { return queue_.empty() && settled_; }
    /// Frames until settled, then what is on the screen.
    [[nodiscard]] Picture8 picture();

    /// The picture in its own size, without panels, to a PNG.
    void savePicture(const std::filesystem::path& target);

  private:
    [[nodiscard]] Picture8 pictureAlone();
    void writeAlone(const std::filesystem::path& target);
    void writeWanted();
    void take(const Event& event);
    void takeKey(const Event& event);
    void takeMove(const Event& event);
    void orbit(double degreesRight, double degreesUp);
    void pan(double pixelsRight, double pixelsDown);
    void dolly(double steps);
    void frameSphere(Vec3 middle, double radius);
    void fly();
    void nextIlluminant();
    void keepOrGo(const Event& event);
    void toHome();
    void frameAll();
    void moveTo(const Pose& pose);
    void addPin(int x, int y);
    void resizePicture(const FaceSize& size);
    void takeSamples();
    void takeNews();
    /// What was clicked is found by the subject, once it is at hand.
    void findClicked();
    void uploadPictures(const FaceSize& size);
    /// Frames until all jobs are done. Throws what a save has thrown.
    void finish();
    void draw(const FaceSize& size);
    void drawPictures(const FaceSize& size);
    /// Of the frame; x, y in window units.
    [[nodiscard]] std::array<int, 2> frameAt(double x, double y) const;
    /// Of the picture.
    [[nodiscard]] std::array<int, 2> pixelUnder(double x, double y) const;
    [[nodiscard]] int dividerColumn(int frameWidth) const;
    /// Runs what may throw an error of the user's, and shows it in the window.
    template <typename Call>
    void said(Call call) {
        panels_.remark.clear();
        try {
            call();
            panels_.message.clear();
        } catch (const InputError& error) {
            panels_.message = error.what();
        } catch (const UsageError& error) {
            panels_.message = error.what();
        } catch (const MachineError& error) {  // a file that cannot be written
            panels_.message = error.what();
        }
    }

    Face& face_;
    Session& session_;
    ImGuiContext* imgui_;
    Canvas canvas_;
    PanelState panels_;
    GLuint left_ = 0, right_ = 0, font_ = 0;
    Codes composed_;
    PicturePlace place_;                         ///< of a cube's picture
    bool placed_ = false;                        ///< the frame holds the pictures as they lie now
    std::optional<std::array<int, 2>> clicked_;  ///< a pixel whose node is asked for
    std::deque<Event> queue_;                    ///< of the face and of scripts, in order
    std::array<std::optional<Pose>, 10> bookmarks_;
    std::array<bool, 3> held_{};    ///< buttons over the picture
    std::array<bool, 512> keys_{};  ///< held down
    double pointerX_ = 0, pointerY_ = 0, pressedX_ = 0, pressedY_ = 0;
    unsigned modifiers_ = 0;
    bool draggingDivider_ = false, flying_ = false, settled_ = false, closed_ = false;
    int samples_ = 1, frameWidth_ = 0, frameHeight_ = 0;
    size_t illuminant_ = 0;
};

/// Plays `actions`, then goes on for `frames` frames, or without a number until the window is closed.
void run(Viewer& viewer, const std::vector<Action>& actions, std::optional<int> frames);

}  // namespace spectrad::view
