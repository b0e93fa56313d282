// What a render is asked for beyond the scene, and what it reports.
#pragma once

#include "spectrum/wavelengths.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

namespace spectrad {

struct Eye;
struct Detector;

/// Which part of what comes from surfaces is wanted (render --only).
enum class Only { everything, reflection, fluorescence };

/// What a pass that is not radiance is made of (docs/format.md, "Passes as reflectance").
enum class Substitute {
    none,
    equalEnergy,  ///< every light keeps place and amount but has a constant spectrum; nothing glows by itself
    whiteDiffuser,  ///< that, and every surface a perfect white diffuser
    irradiance,     ///< every surface a perfect white diffuser, under the lights as they are
    coverage        ///< every surface glows with radiance 1, whatever the light
};

/// What an image holds: the kinds of a pass (scene.h).
enum class PassKind;

/// A surface rendered into its own texture's square (spectrad bake).
struct Bake {
    std::string node;
    PassKind as;
    int gutter = 4;  ///< texels filled around what the surface covers
};

struct RenderSettings {
    std::optional<Wavelengths> wavelengths;   ///< instead of the scene's
    std::optional<Projection> projection;     ///< instead of the wavelengths' own
    std::optional<std::pair<int, int>> size;  ///< width, height in pixels
    std::optional<int> samples;               ///< per pixel, 1…64; 16 if nobody says
    std::string camera, pass;                 ///< names; empty: the scene's choice (docs/format.md, "Passes")
    Only only = Only::everything;
    Substitute substitute = Substitute::none;
    std::optional<Bake> bake;      ///< instead of a picture; the camera is then the eye
    int cubeFace = 0;              ///< of a camera of type cube: which of its six faces
    std::uint64_t stripBytes = 0;  ///< device memory a strip may take; 0: chosen from the device
    const Eye* eye = nullptr;      ///< who sees the preview and the white; CIE 1931 if not said
    bool lightsApart = false;      ///< a group for each light: its spectrum and amount are in its terms alone
    const Detector* exact =
        nullptr;           ///< who sees TermTable::exactChannels (references want them); nobody if not said
    bool geometry = true;  ///< false: materials, lights and terms only, no triangles
    std::stop_token stop;  ///< passes end with Stopped (base/stopped.h) between strips when it is asked for
};

/// Rows of the finished image, top to bottom, without gaps: bands[(row * bands + band) * width + x] in
/// W·m⁻²·sr⁻¹·nm⁻¹ and a linear Rec.709 preview[(row * 3 + channel) * width + x]. The memory is the
/// renderer's.
using StripSink = std::function<void(int firstRow, int rows, const float* bands, const float* preview)>;
/// Share done, 0…1.
using Progress = std::function<void(double)>;

struct RenderTimes {
    double build = 0, render = 0;  ///< s: compiling kernels; from geometry to strips, without what takes them
};

}  // namespace spectrad
