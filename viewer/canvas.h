// Drawing: pictures pixel by pixel, and Dear ImGui's lists of triangles, with one shader.
#pragma once

#include "image/picture.h"
#include "viewer/gl.h"

#include <array>
#include <cstdint>
#include <map>
#include <vector>

struct ImDrawData;

namespace spectrad::view {

class Canvas {
  public:
    explicit Canvas(const Face& face);
    ~Canvas();
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    /// A texture of RGBA bytes; drawn without blending of neighbours unless `smooth`.
    [[nodiscard]] GLuint makeTexture(bool smooth);
    void upload(GLuint texture, int width, int height, const std::uint32_t* pixels);

    void begin(int width, int height);  ///< the frame, pixels; cleared to dark grey
    /// The picture with its upper left corner in the frame's, but columns [from, to) only. `zebra` stripes
    /// what lies outside the display's gamut (A = 254).
    void drawPicture(GLuint texture, int width, int height, int from, int to, bool zebra);
    void drawInterface(const ImDrawData& data);
    void end();  ///< throws MachineError if OpenGL found fault with the frame

    /// What was drawn.
    [[nodiscard]] Picture8 read() const;

  private:
    void use(int width, int height, bool zebra);
    void drawTriangles(const void* vertices, size_t vertexBytes, const void* indices, size_t indexBytes);

    Gl gl_;
    GLuint program_ = 0, array_ = 0, vertices_ = 0, indices_ = 0;
    GLint scale_ = -1, zebra_ = -1;
    std::vector<GLuint> textures_;
    std::map<GLuint, std::array<int, 2>> sizes_;
    int width_ = 0, height_ = 0;
};

}  // namespace spectrad::view
