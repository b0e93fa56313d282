// The viewer at work: events move the camera and the panels, frames are drawn, scripts are played. The same
// for a window and off screen.
#pragma once

#include "viewer/canvas.h"
#include "viewer/panels.h"
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

  private:
    void take(const Event& event);
    void takeKey(const Event& event);
    void takeMove(const Event& event);
    void orbit(double degreesRight, double degreesUp);
    void pan(double pixelsRight, double pixelsDown);
    void dolly(double steps);
    void frameAt(Vec3 middle, double radius);
    void fly();
    void select(int x, int y);
    void nextIlluminant();
    void resizePicture(const FaceSize& size);
    void draw(const FaceSize& size);
    [[nodiscard]] std::array<int, 2> pixelUnder(double x, double y) const;
    /// Runs what may throw an error of the user's, and shows it in the window.
    template <typename Call>
    void said(Call call);

    Face& face_;
    Session& session_;
    ImGuiContext* imgui_;
    Canvas canvas_;
    PanelState panels_;
    GLuint left_ = 0, right_ = 0, font_ = 0;
    std::vector<std::uint32_t> leftPixels_, rightPixels_;
    std::deque<Event> queue_;  ///< of the face and of scripts, in order
    Pose home_;
    std::array<std::optional<Pose>, 10> bookmarks_;
    std::array<bool, 3> held_{};    ///< buttons over the picture
    std::array<bool, 512> keys_{};  ///< held down
    double pointerX_ = 0, pointerY_ = 0, pressedX_ = 0, pressedY_ = 0;
    unsigned modifiers_ = 0;
    bool draggingDivider_ = false, settled_ = false, closed_ = false;
    int samples_ = 1;
    size_t illuminant_ = 0;
};

/// Plays `actions`, then goes on for `frames` frames, or without a number until the window is closed.
void run(Viewer& viewer, const std::vector<Action>& actions, std::optional<int> frames);

}  // namespace spectrad::view
