// What Assimp loses of COLLADA's cameras: all optics of one without a name, a lone vertical angle,
// orthographic views, and the aspect of two angles. They are read from the file itself. Runs in the child
// process of importModel().
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <unordered_map>

namespace spectrad {

/// <perspective> or <orthographic> as stated; angles in degrees, full; xmag and ymag are half the view's
/// width and height.
struct ColladaOptics {
    std::optional<double> xfov, yfov, xmag, ymag, aspect;

    [[nodiscard]] bool orthographic() const { return xmag || ymag; }
    /// Width by height as far as the file states it.
    [[nodiscard]] std::optional<double> widthByHeight() const;
    /// Of a perspective view, degrees; without an aspect `otherwise` is taken for it.
    [[nodiscard]] std::optional<double> verticalFov(double otherwise) const;
    /// Of an orthographic view.
    [[nodiscard]] std::optional<double> height(double otherwise) const;
};

/// By the id (the name, where there is none) of the node that instances the camera. Empty for what is no
/// plain XML file.
[[nodiscard]] std::unordered_map<std::string, ColladaOptics> colladaOptics(const std::filesystem::path& path);

}  // namespace spectrad
