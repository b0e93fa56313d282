// Where the viewer meets the world: a window, or a frame off screen. Events come in, pixels drawn with OpenGL
// 3.3 go out; nothing else in the viewer knows which of the two it is.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace spectrad::view {

/// Keys by GLFW's numbers: printable ones are their capital letter, others follow.
enum Key : int {
    escape = 256,
    enter = 257,
    tab = 258,
    backspace = 259,
    insert = 260,
    del = 261,
    right = 262,
    left = 263,
    down = 264,
    up = 265,
    pageUp = 266,
    pageDown = 267,
    home = 268,
    end = 269,
    f1 = 290,
    f12 = 301
};
enum Modifier : unsigned { shift = 1, control = 2, alt = 4 };

struct Event {
    enum class Kind { key, text, move, button, scroll, close } kind = Kind::move;
    int code = 0;            ///< key, or button (0 left, 1 right, 2 middle), or the character of a text
    bool pressed = false;    ///< key, button
    unsigned modifiers = 0;  ///< key, button
    double x = 0, y = 0;     ///< move: window units from the top left; scroll: steps
};

struct FaceSize {
    int width = 0, height = 0;            ///< window units, in which the pointer moves; 0 when minimised
    int pixelWidth = 0, pixelHeight = 0;  ///< of the frame; more than that on HiDPI screens
};

using GlFunction = void (*)();

class Face {
  public:
    virtual ~Face() = default;
    Face() = default;
    Face(const Face&) = delete;
    Face& operator=(const Face&) = delete;

    [[nodiscard]] virtual GlFunction glFunction(const char* name) const = 0;
    [[nodiscard]] virtual FaceSize size() const = 0;
    virtual void resize(int width, int height) = 0;  ///< window units
    virtual void setTitle(const std::string& title) = 0;
    /// Events since the last call, waiting for one for up to `seconds`. Throws MachineError when the display
    /// is lost.
    [[nodiscard]] virtual std::vector<Event> events(double seconds) = 0;
    virtual void present() = 0;  ///< what was drawn is shown
};

/// A window of OpenGL 3.3. Throws MachineError in one line where there is no display or no such OpenGL.
[[nodiscard]] std::unique_ptr<Face> openWindow(int width, int height, const std::string& title);
/// A frame in memory (OSMesa, found when asked for). Throws MachineError where it is not installed.
[[nodiscard]] std::unique_ptr<Face> openOffscreen(int width, int height);

}  // namespace spectrad::view
