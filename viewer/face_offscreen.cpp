// OSMesa off screen. Loaded when asked for: it brings LLVM with it, which no other command should wait for.
#include "base/error.h"
#include "viewer/face.h"

#include <algorithm>
#include <cstdint>
#include <dlfcn.h>

namespace spectrad::view {

namespace {

// GL/osmesa.h, the part that is used.
constexpr int osmesaRgba = 0x1908, osmesaFormat = 0x22, osmesaDepthBits = 0x30, osmesaProfile = 0x33,
              osmesaCoreProfile = 0x34, osmesaMajor = 0x36, osmesaMinor = 0x37;
constexpr unsigned glUnsignedByte = 0x1401;

class Offscreen : public Face {
  public:
    Offscreen(int width, int height) {
        library_ = ::dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
        if (!library_) library_ = ::dlopen("libOSMesa.so", RTLD_NOW | RTLD_LOCAL);
        if (!library_)
            throw MachineError("drawing off screen needs libOSMesa (Debian: libosmesa6), which is not there");
        try {
            find(create_, "OSMesaCreateContextAttribs");
            find(destroy_, "OSMesaDestroyContext");
            find(makeCurrent_, "OSMesaMakeCurrent");
            find(function_, "OSMesaGetProcAddress");
            const int attributes[] = {osmesaFormat,
                                      osmesaRgba,
                                      osmesaDepthBits,
                                      0,
                                      osmesaProfile,
                                      osmesaCoreProfile,
                                      osmesaMajor,
                                      3,
                                      osmesaMinor,
                                      3,
                                      0};
            context_ = create_(attributes, nullptr);
            if (!context_) throw MachineError("OSMesa gives no OpenGL 3.3");
            resize(width, height);
        } catch (...) {
            close();
            throw;
        }
    }
    ~Offscreen() override { close(); }

    [[nodiscard]] GlFunction glFunction(const char* name) const override { return function_(name); }
    [[nodiscard]] FaceSize size() const override { return {width_, height_, width_, height_}; }
    void resize(int width, int height) override {
        width_ = std::max(width, 0);
        height_ = std::max(height, 0);
        // A frame of no size is a minimised window: nothing is drawn into it.
        const int w = std::max(width_, 1), h = std::max(height_, 1);
        frame_.assign(static_cast<size_t>(w) * static_cast<size_t>(h), 0);
        if (!makeCurrent_(context_, frame_.data(), glUnsignedByte, w, h))
            throw MachineError("OSMesa gives no frame of " + std::to_string(w) + " x " + std::to_string(h) +
                               " pixels");
    }
    void setTitle(const std::string&) override {}
    [[nodiscard]] std::vector<Event> events(double) override { return {}; }
    void present() override {}

  private:
    template <typename Function>
    void find(Function& function, const char* name) {
        function = reinterpret_cast<Function>(::dlsym(library_, name));
        if (!function) throw MachineError(std::string("libOSMesa lacks ") + name);
    }
    void close() {
        if (context_) destroy_(context_);
        context_ = nullptr;
        // The library stays loaded: LLVM registers things that must not go before the process ends.
    }

    void* library_ = nullptr;
    void* context_ = nullptr;
    void* (*create_)(const int*, void*) = nullptr;
    void (*destroy_)(void*) = nullptr;
    unsigned char (*makeCurrent_)(void*, void*, unsigned, int, int) = nullptr;
    GlFunction (*function_)(const char*) = nullptr;
    int width_ = 0, height_ = 0;
    std::vector<std::uint32_t> frame_;
};

}  // namespace

std::unique_ptr<Face> openOffscreen(int width, int height) {
    return std::make_unique<Offscreen>(width, height);
}

}  // namespace spectrad::view
