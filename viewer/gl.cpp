#include "viewer/gl.h"

#include "base/error.h"

#include <fmt/format.h>

namespace spectrad::view {

Gl::Gl(const Face& face) {
    const auto find = [&](auto& function, const char* name) {
        function = reinterpret_cast<std::decay_t<decltype(function)>>(face.glFunction(name));
        if (!function) throw MachineError(std::string("OpenGL lacks ") + name);
    };
    find(getError, "glGetError");
    find(viewport, "glViewport");
    find(scissor, "glScissor");
    find(clearColor, "glClearColor");
    find(clear, "glClear");
    find(enable, "glEnable");
    find(disable, "glDisable");
    find(blendFunc, "glBlendFunc");
    find(pixelStorei, "glPixelStorei");
    find(readPixels, "glReadPixels");
    find(genTextures, "glGenTextures");
    find(deleteTextures, "glDeleteTextures");
    find(bindTexture, "glBindTexture");
    find(texParameteri, "glTexParameteri");
    find(texImage2D, "glTexImage2D");
    find(texSubImage2D, "glTexSubImage2D");
    find(activeTexture, "glActiveTexture");
    find(genBuffers, "glGenBuffers");
    find(deleteBuffers, "glDeleteBuffers");
    find(bindBuffer, "glBindBuffer");
    find(bufferData, "glBufferData");
    find(genVertexArrays, "glGenVertexArrays");
    find(deleteVertexArrays, "glDeleteVertexArrays");
    find(bindVertexArray, "glBindVertexArray");
    find(enableVertexAttribArray, "glEnableVertexAttribArray");
    find(vertexAttribPointer, "glVertexAttribPointer");
    find(drawElementsBaseVertex, "glDrawElementsBaseVertex");
    find(createShader, "glCreateShader");
    find(shaderSource, "glShaderSource");
    find(compileShader, "glCompileShader");
    find(getShaderiv, "glGetShaderiv");
    find(deleteShader, "glDeleteShader");
    find(createProgram, "glCreateProgram");
    find(attachShader, "glAttachShader");
    find(linkProgram, "glLinkProgram");
    find(getProgramiv, "glGetProgramiv");
    find(deleteProgram, "glDeleteProgram");
    find(useProgram, "glUseProgram");
    find(getUniformLocation, "glGetUniformLocation");
    find(uniform1i, "glUniform1i");
    find(uniform2f, "glUniform2f");
}

void Gl::check(const char* doing) const {
    if (const GLenum error = getError(); error != GL_NO_ERROR)
        throw MachineError(fmt::format("OpenGL error {:#06x} after {}", error, doing));
}

}  // namespace spectrad::view
