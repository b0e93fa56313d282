#include "viewer/canvas.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <imgui.h>

namespace spectrad::view {

namespace {

// Positions are pixels of the frame from the top left.
constexpr const char* vertexShader = R"(#version 330
uniform vec2 scale;
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 place;
layout(location = 2) in vec4 colour;
out vec2 uv;
out vec4 tint;
void main() {
    uv = place;
    tint = colour;
    gl_Position = vec4(position.x * scale.x - 1.0, 1.0 - position.y * scale.y, 0.0, 1.0);
})";
// Textures hold codes of the display: nothing here knows about light.
constexpr const char* fragmentShader = R"(#version 330
uniform sampler2D picture;
uniform int zebra;
in vec2 uv;
in vec4 tint;
layout(location = 0) out vec4 colour;
void main() {
    colour = texture(picture, uv) * tint;
    if (zebra != 0 && colour.a < 0.999 && mod(gl_FragCoord.x + gl_FragCoord.y, 8.0) < 4.0)
        colour.rgb = vec3(1.0, 0.0, 1.0);
})";

GLuint compiled(const Gl& gl, GLenum kind, const char* text) {
    const GLuint shader = gl.createShader(kind);
    gl.shaderSource(shader, 1, &text, nullptr);
    gl.compileShader(shader);
    GLint done = 0;
    gl.getShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (!done) throw MachineError("OpenGL: a shader of the viewer does not compile");
    return shader;
}

}  // namespace

Canvas::Canvas(const Face& face) : gl_(face) {
    const GLuint vertex = compiled(gl_, GL_VERTEX_SHADER, vertexShader),
                 fragment = compiled(gl_, GL_FRAGMENT_SHADER, fragmentShader);
    program_ = gl_.createProgram();
    gl_.attachShader(program_, vertex);
    gl_.attachShader(program_, fragment);
    gl_.linkProgram(program_);
    gl_.deleteShader(vertex);
    gl_.deleteShader(fragment);
    GLint linked = 0;
    gl_.getProgramiv(program_, GL_LINK_STATUS, &linked);
    if (!linked) throw MachineError("OpenGL: the viewer's shaders do not link");
    scale_ = gl_.getUniformLocation(program_, "scale");
    zebra_ = gl_.getUniformLocation(program_, "zebra");

    gl_.genVertexArrays(1, &array_);
    gl_.genBuffers(1, &vertices_);
    gl_.genBuffers(1, &indices_);
    gl_.bindVertexArray(array_);
    gl_.bindBuffer(GL_ARRAY_BUFFER, vertices_);
    gl_.bindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
    const auto at = [](size_t offset) { return reinterpret_cast<const void*>(offset); };
    constexpr GLsizei stride = sizeof(ImDrawVert);
    gl_.vertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, stride, at(offsetof(ImDrawVert, pos)));
    gl_.vertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, stride, at(offsetof(ImDrawVert, uv)));
    gl_.vertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, at(offsetof(ImDrawVert, col)));
    for (GLuint i = 0; i < 3; ++i)
        gl_.enableVertexAttribArray(i);
    gl_.check("making the viewer's shaders");
}

Canvas::~Canvas() {
    for (const GLuint texture : textures_)
        gl_.deleteTextures(1, &texture);
    gl_.deleteBuffers(1, &vertices_);
    gl_.deleteBuffers(1, &indices_);
    gl_.deleteVertexArrays(1, &array_);
    gl_.deleteProgram(program_);
}

GLuint Canvas::makeTexture(bool smooth) {
    GLuint texture = 0;
    gl_.genTextures(1, &texture);
    textures_.push_back(texture);
    gl_.bindTexture(GL_TEXTURE_2D, texture);
    const GLint filter = smooth ? GL_LINEAR : GL_NEAREST;
    gl_.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    gl_.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    gl_.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl_.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

void Canvas::upload(GLuint texture, int width, int height, const std::uint32_t* pixels) {
    gl_.bindTexture(GL_TEXTURE_2D, texture);
    gl_.pixelStorei(GL_UNPACK_ALIGNMENT, 4);
    // A texture that keeps its size keeps its memory.
    if (std::array<int, 2>& size = sizes_[texture]; size != std::array{width, height}) {
        gl_.texImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
        size = {width, height};
    } else {
        gl_.texSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    }
    gl_.check("uploading a picture");
}

void Canvas::begin(int width, int height) {
    width_ = width;
    height_ = height;
    gl_.viewport(0, 0, width, height);
    gl_.disable(GL_SCISSOR_TEST);
    gl_.disable(GL_BLEND);
    gl_.clearColor(0.11f, 0.11f, 0.12f, 1);
    gl_.clear(GL_COLOR_BUFFER_BIT);
}

void Canvas::use(int width, int height, bool zebra) {
    gl_.useProgram(program_);
    gl_.uniform2f(scale_, 2.0f / static_cast<float>(width), 2.0f / static_cast<float>(height));
    gl_.uniform1i(zebra_, zebra ? 1 : 0);
    gl_.activeTexture(GL_TEXTURE0);
    gl_.bindVertexArray(array_);
    gl_.bindBuffer(GL_ARRAY_BUFFER, vertices_);
}

void Canvas::drawTriangles(const void* vertices, size_t vertexBytes, const void* indices, size_t indexBytes) {
    gl_.bufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertexBytes), vertices, GL_STREAM_DRAW);
    gl_.bufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indexBytes), indices, GL_STREAM_DRAW);
}

void Canvas::drawPicture(GLuint texture, int width, int height, int from, int to, bool zebra) {
    from = std::clamp(from, 0, width);
    to = std::clamp(to, from, width);
    if (from == to) return;
    use(width_, height_, zebra);
    const auto x0 = static_cast<float>(from), x1 = static_cast<float>(to), y = static_cast<float>(height);
    const float u0 = x0 / static_cast<float>(width), u1 = x1 / static_cast<float>(width);
    const std::array<ImDrawVert, 4> corners{{{{x0, 0}, {u0, 0}, IM_COL32_WHITE},
                                             {{x1, 0}, {u1, 0}, IM_COL32_WHITE},
                                             {{x1, y}, {u1, 1}, IM_COL32_WHITE},
                                             {{x0, y}, {u0, 1}, IM_COL32_WHITE}}};
    const std::array<ImDrawIdx, 6> order{0, 1, 2, 0, 2, 3};
    gl_.bindTexture(GL_TEXTURE_2D, texture);
    drawTriangles(corners.data(), sizeof corners, order.data(), sizeof order);
    gl_.drawElementsBaseVertex(GL_TRIANGLES, 6, GL_UNSIGNED_SHORT, nullptr, 0);
}

void Canvas::drawInterface(const ImDrawData& data) {
    static_assert(sizeof(ImDrawIdx) == 2, "indices go to OpenGL as they are");
    use(width_, height_, false);
    gl_.enable(GL_BLEND);
    gl_.blendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl_.enable(GL_SCISSOR_TEST);
    for (int n = 0; n < data.CmdListsCount; ++n) {
        const ImDrawList& list = *data.CmdLists[n];
        drawTriangles(list.VtxBuffer.Data, static_cast<size_t>(list.VtxBuffer.size_in_bytes()),
                      list.IdxBuffer.Data, static_cast<size_t>(list.IdxBuffer.size_in_bytes()));
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const ImVec4& clip = command.ClipRect;
            const int x = std::max(0, static_cast<int>(clip.x)),
                      right = std::min(width_, static_cast<int>(clip.z)),
                      y = std::max(0, static_cast<int>(clip.y)),
                      bottom = std::min(height_, static_cast<int>(clip.w));
            if (right <= x || bottom <= y || command.ElemCount == 0) continue;
            gl_.scissor(x, height_ - bottom, right - x, bottom - y);
            gl_.bindTexture(GL_TEXTURE_2D,
                            static_cast<GLuint>(reinterpret_cast<std::uintptr_t>(command.GetTexID())));
            gl_.drawElementsBaseVertex(
                GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount), GL_UNSIGNED_SHORT,
                reinterpret_cast<const void*>(size_t{command.IdxOffset} * sizeof(ImDrawIdx)),
                static_cast<GLint>(command.VtxOffset));
        }
    }
    gl_.disable(GL_SCISSOR_TEST);
    gl_.disable(GL_BLEND);
}

void Canvas::end() {
    gl_.check("drawing a frame");
}

Picture8 Canvas::read() const {
    Picture8 picture{width_, height_, 3, {}};
    const size_t row = size_t{3} * static_cast<size_t>(width_);
    std::vector<std::uint8_t> upward(row * static_cast<size_t>(height_));
    gl_.pixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_.readPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, upward.data());
    gl_.check("reading the frame");
    // OpenGL's first row is the lowest.
    for (size_t y = static_cast<size_t>(height_); y-- > 0;)
        picture.pixels.insert(picture.pixels.end(), upward.begin() + static_cast<std::ptrdiff_t>(y * row),
                              upward.begin() + static_cast<std::ptrdiff_t>((y + 1) * row));
    return picture;
}

}  // namespace spectrad::view
