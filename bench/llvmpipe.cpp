#include "llvmpipe.h"

#include "base/error.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <GL/osmesa.h>
#include <array>
#include <cstddef>

namespace spectrad::bench {

namespace {

// z: 1 at the near plane 0.1 m, −1 far away; only the order counts.
constexpr const char* vertexShader = R"(#version 330
uniform vec2 slope;
uniform mat4 camera;
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 colour;
layout(location = 2) in vec3 normal;
flat out vec4 shade;
out vec3 place;
out vec3 upright;
void main() {
    shade = colour;
    place = (camera * vec4(position, 1.0)).xyz;
    upright = mat3(camera) * normal;
    gl_Position = vec4(place.xy * slope, -place.z - 0.2, -place.z);
})";
constexpr const char* flatShader = R"(#version 330
flat in vec4 shade;
layout(location = 0) out vec4 colour;
void main() { colour = shade; })";
constexpr const char* litShader = R"(#version 330
flat in vec4 shade;
in vec3 place;
in vec3 upright;
layout(location = 0) out vec4 colour;
void main() {
    float facing = abs(dot(normalize(upright), normalize(place)));
    colour = vec4(shade.rgb * (facing * 16.0 / dot(place, place)), 1.0);
})";

GLuint compiled(GLenum kind, const char* text) {
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint done = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (!done) throw MachineError("OSMesa: a shader does not compile");
    return shader;
}

template <typename T>
void fill(GLenum target, const std::vector<T>& data) {
    GLuint buffer = 0;
    glGenBuffers(1, &buffer);
    glBindBuffer(target, buffer);
    glBufferData(target, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), GL_STATIC_DRAW);
}

}  // namespace

struct Llvmpipe::Body {
    OSMesaContext context = nullptr;
    std::array<unsigned char, 16 * 16 * 4> window{};  // OSMesa wants one; everything is drawn into frame
    GLuint frame = 0;
    int width = 0, height = 0, samples = 1;
    GLsizei indices = 0;
    GLint camera = -1;

    ~Body() {
        if (context) OSMesaDestroyContext(context);
    }
    void bind() { OSMesaMakeCurrent(context, window.data(), GL_UNSIGNED_BYTE, 16, 16); }
    GLuint makeFrame(int count) const;
};

GLuint Llvmpipe::Body::makeFrame(int count) const {
    GLuint made = 0;
    std::array<GLuint, 2> planes{};
    glGenFramebuffers(1, &made);
    glBindFramebuffer(GL_FRAMEBUFFER, made);
    glGenRenderbuffers(2, planes.data());
    const std::array<std::pair<GLenum, GLenum>, 2> kinds{
        {{GL_RGBA8, GL_COLOR_ATTACHMENT0}, {GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT}}};
    for (size_t i = 0; i < 2; ++i) {
        glBindRenderbuffer(GL_RENDERBUFFER, planes[i]);
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, count > 1 ? count : 0, kinds[i].first, width,
                                         height);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, kinds[i].second, GL_RENDERBUFFER, planes[i]);
    }
    GLint given = 0;
    glGetRenderbufferParameteriv(GL_RENDERBUFFER, GL_RENDERBUFFER_SAMPLES, &given);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE || (count > 1 && given != count))
        throw MachineError("OSMesa: no frame buffer of " + std::to_string(count) + " samples");
    return made;
}

Llvmpipe::Llvmpipe(const Plan& plan, int samples, bool lit) : body_(std::make_unique<Body>()) {
    Body& body = *body_;
    const std::array<int, 9> attributes{OSMESA_FORMAT,
                                        OSMESA_RGBA,
                                        OSMESA_PROFILE,
                                        OSMESA_CORE_PROFILE,
                                        OSMESA_CONTEXT_MAJOR_VERSION,
                                        3,
                                        OSMESA_CONTEXT_MINOR_VERSION,
                                        3,
                                        0};
    body.context = OSMesaCreateContextAttribs(attributes.data(), nullptr);
    if (!body.context) throw MachineError("OSMesa gives no OpenGL 3.3");
    body.bind();
    body.width = plan.view.width;
    body.height = plan.view.height;
    body.samples = samples;
    body.frame = body.makeFrame(samples);

    GLuint array = 0;
    glGenVertexArrays(1, &array);
    glBindVertexArray(array);
    const World& world = plan.world;
    fill(GL_ARRAY_BUFFER, world.position);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    glEnableVertexAttribArray(0);
    std::vector<std::uint32_t> colours(world.position.size() / 3);
    for (size_t v = 0; v < colours.size(); ++v)
        colours[v] = static_cast<std::uint32_t>(v * 2654435761u) | 0xff000000u;
    fill(GL_ARRAY_BUFFER, colours);
    glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, 0, nullptr);
    glEnableVertexAttribArray(1);
    if (lit) {
        fill(GL_ARRAY_BUFFER, world.normal);
        glVertexAttribPointer(2, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
        glEnableVertexAttribArray(2);
    }
    fill(GL_ELEMENT_ARRAY_BUFFER, world.index);
    body.indices = static_cast<GLsizei>(world.index.size());

    const GLuint program = glCreateProgram();
    glAttachShader(program, compiled(GL_VERTEX_SHADER, vertexShader));
    glAttachShader(program, compiled(GL_FRAGMENT_SHADER, lit ? litShader : flatShader));
    glLinkProgram(program);
    glUseProgram(program);
    glUniform2f(glGetUniformLocation(program, "slope"),
                static_cast<float>(2 * plan.view.pixelsPerSlope / body.width),
                static_cast<float>(2 * plan.view.pixelsPerSlope / body.height));
    body.camera = glGetUniformLocation(program, "camera");
    look(Affine{});
    glViewport(0, 0, body.width, body.height);
    glEnable(GL_DEPTH_TEST);
    glClearColor(0, 0, 0, 0);
    if (const GLenum error = glGetError(); error != GL_NO_ERROR)
        throw MachineError("OSMesa: OpenGL error " + std::to_string(error));
}

Llvmpipe::~Llvmpipe() = default;

void Llvmpipe::look(const Affine& toCamera) {
    body_->bind();
    std::array<float, 16> m{};
    for (size_t row = 0; row < 3; ++row)
        for (size_t column = 0; column < 4; ++column)
            m[4 * column + row] = static_cast<float>(toCamera.m[4 * row + column]);
    m[15] = 1;
    glUniformMatrix4fv(body_->camera, 1, GL_FALSE, m.data());
}

void Llvmpipe::draw() {
    body_->bind();
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glDrawElements(GL_TRIANGLES, body_->indices, GL_UNSIGNED_INT, nullptr);
    glFinish();
}

size_t Llvmpipe::coveredPixels() {
    body_->bind();
    const size_t count = static_cast<size_t>(body_->width) * static_cast<size_t>(body_->height);
    std::vector<std::uint32_t> pixels(count);
    GLuint plain = body_->frame;
    if (body_->samples > 1) {
        plain = body_->makeFrame(1);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, body_->frame);
        glBlitFramebuffer(0, 0, body_->width, body_->height, 0, 0, body_->width, body_->height,
                          GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
    glBindFramebuffer(GL_READ_FRAMEBUFFER, plain);
    glReadPixels(0, 0, body_->width, body_->height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    glBindFramebuffer(GL_FRAMEBUFFER, body_->frame);
    size_t covered = 0;
    for (std::uint32_t pixel : pixels)
        covered += pixel != 0;
    return covered;
}

std::string Llvmpipe::name() const {
    body_->bind();
    return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

}  // namespace spectrad::bench
