// The viewer's actions as text, a line each (docs/format.md, "view"): what a hand can do, and what only a
// test wants.
#pragma once

#include "base/error.h"
#include "viewer/face.h"

#include <string>
#include <string_view>
#include <vector>

namespace spectrad::view {

struct Action {
    enum class Kind {
        events,       ///< keys, pointer, buttons
        set,          ///< text: "lamp.spectrum=illuminants/A"
        camera,       ///< text: orbit, pan, dolly, frame; x, y
        resize,       ///< x, y: window units
        screenshot,   ///< text: PNG
        savePicture,  ///< text: PNG without panels
        saveCube,     ///< text: EXR or ENVI
        saveScene,    ///< text: XML
        channels,     ///< text: EXR of X, Y, Z
        pin,          ///< x, y
        pins,         ///< text: CSV
        wait,         ///< x: frames
        jobs,         ///< x: 1, frames wait for them; 0, they go on beside
        finish,       ///< until all jobs are done
        close
    } kind = Kind::events;
    std::vector<Event> events;
    std::string text;
    double x = 0, y = 0;
    SourceLocation where{};  ///< in the script
};

/// Throws InputError `file:line:1: …` for what is no action.
[[nodiscard]] std::vector<Action> parseScript(std::string_view text, const std::string& file);

}  // namespace spectrad::view
