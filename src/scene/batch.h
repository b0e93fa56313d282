// What a scene asks of `spectrad sweep`: spectra to go through, detectors to look, and parts of the picture
// to measure. Nothing else reads them.
#pragma once

#include "base/error.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace spectrad {

struct PixelRect {
    int x = 0, y = 0, width = 0, height = 0;  ///< pixels, (0,0) top left
};

/// <region>: a rectangle of the picture, or the pixels that a node fills.
struct Region {
    std::string name;
    std::optional<PixelRect> rect;      ///< exactly one of these two
    std::optional<std::uint32_t> node;  ///< of Scene::nodes
    SourceLocation where;
};

/// <vary>: attributes (as --set names them) that take each value together.
struct SweepAxis {
    std::vector<std::string> attributes, values;
    SourceLocation where;
};

/// <sweep>: every combination of its axes' values, each seen by every detector.
struct Sweep {
    std::string name, camera, pass;      ///< camera and pass may be empty: the scene's choice
    std::vector<std::string> detectors;  ///< names of <detector>s, else of observers, cameras or films
    std::vector<SweepAxis> axes;
    SourceLocation where;
};

}  // namespace spectrad
