// A window by GLFW.
#include "base/error.h"
#include "viewer/face.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <dlfcn.h>
#include <utility>

namespace spectrad::view {

extern "C" void* glfwGetX11Display();  // of GLFW built for X11; its own header wants X11's

namespace {

/// Sets `lost` when the connection to the X server breaks. Xlib's own answer is to end the process.
void watchDisplay(bool& lost) {
    void* library = ::dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);
    if (!library) return;
    using Handler = int (*)(void*);
    using ExitHandler = void (*)(void*, void*);
    const auto set = reinterpret_cast<Handler (*)(Handler)>(::dlsym(library, "XSetIOErrorHandler"));
    const auto setExit =
        reinterpret_cast<void (*)(void*, ExitHandler, void*)>(::dlsym(library, "XSetIOErrorExitHandler"));
    void* display = glfwGetX11Display();
    if (set && setExit && display) {
        set([](void*) { return 0; });
        setExit(
            display, [](void*, void* flag) { *static_cast<bool*>(flag) = true; }, &lost);
    }
    ::dlclose(library);
}

std::string lastError() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason given";
}

class Window : public Face {
  public:
    Window(int width, int height, const std::string& title) {
        if (!glfwInit()) throw MachineError("no window can be opened: " + lastError());
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
        if (!window_) {
            const std::string reason = lastError();
            glfwTerminate();
            throw MachineError("no window of OpenGL 3.3 can be opened: " + reason);
        }
        watchDisplay(displayLost_);
        glfwMakeContextCurrent(window_);
        glfwSwapInterval(1);
        glfwSetWindowUserPointer(window_, this);
        glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int mods) {
            if (action == GLFW_REPEAT || key < 0) return;
            add(w, {Event::Kind::key, key, action == GLFW_PRESS, modifiersOf(mods), 0, 0});
        });
        glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned c) {
            add(w, {Event::Kind::text, static_cast<int>(c), true, 0, 0, 0});
        });
        glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
            add(w, {Event::Kind::move, 0, false, 0, x, y});
        });
        glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int mods) {
            add(w, {Event::Kind::button, button, action == GLFW_PRESS, modifiersOf(mods), 0, 0});
        });
        glfwSetScrollCallback(window_, [](GLFWwindow* w, double x, double y) {
            add(w, {Event::Kind::scroll, 0, false, 0, x, y});
        });
        glfwSetWindowCloseCallback(window_, [](GLFWwindow* w) {
            add(w, {Event::Kind::close, 0, false, 0, 0, 0});
        });
    }
    ~Window() override {
        if (displayLost_) return;  // nobody is left to be told
        glfwDestroyWindow(window_);
        glfwTerminate();
    }

    [[nodiscard]] GlFunction glFunction(const char* name) const override { return glfwGetProcAddress(name); }
    [[nodiscard]] FaceSize size() const override {
        FaceSize size;
        glfwGetWindowSize(window_, &size.width, &size.height);
        glfwGetFramebufferSize(window_, &size.pixelWidth, &size.pixelHeight);
        if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED)) return {};
        return size;
    }
    void resize(int width, int height) override {
        // A window of no size is one that is minimised.
        if (width < 1 || height < 1) {
            glfwIconifyWindow(window_);
            return;
        }
        if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED)) glfwRestoreWindow(window_);
        glfwSetWindowSize(window_, width, height);
    }
    void setTitle(const std::string& title) override { glfwSetWindowTitle(window_, title.c_str()); }
    [[nodiscard]] std::vector<Event> events(double seconds) override {
        if (seconds > 0)
            glfwWaitEventsTimeout(seconds);
        else
            glfwPollEvents();
        if (displayLost_) throw MachineError("the display is lost: the connection to it broke");
        return std::exchange(events_, {});
    }
    void present() override { glfwSwapBuffers(window_); }

  private:
    static unsigned modifiersOf(int mods) {
        return (mods & GLFW_MOD_SHIFT ? shift : 0u) | (mods & GLFW_MOD_CONTROL ? control : 0u) |
               (mods & GLFW_MOD_ALT ? alt : 0u);
    }
    static void add(GLFWwindow* window, const Event& event) {
        static_cast<Window*>(glfwGetWindowUserPointer(window))->events_.push_back(event);
    }

    GLFWwindow* window_ = nullptr;
    bool displayLost_ = false;
    std::vector<Event> events_;
};

}  // namespace

std::unique_ptr<Face> openWindow(int width, int height, const std::string& title) {
    return std::make_unique<Window>(width, height, title);
}

}  // namespace spectrad::view
