// spectrad view: a scene or a cube in a window, or off screen by a script.
#include "base/files.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options.h"
#include "image/cube.h"
#include "image/picture.h"
#include "spectrum/library.h"
#include "viewer/viewer.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <limits>

namespace spectrad {

namespace {

struct ViewArguments {
    SceneArguments scene;
    std::string offscreen, frames, script;
    bool plain = false, quiet = false;
};

/// What opens the scene or the cube, now and after each change on disk.
view::Opener openerOf(const ViewArguments& arguments, const Library& library) {
    const SceneArguments& scene = arguments.scene;
    if (looksLikeCube(scene.file)) {
        SceneArguments others = scene;
        others.size.clear();  // the window's
        if (const std::string given = recorded(others); !given.empty())
            throw UsageError("'" + scene.file + "' is a cube, whose picture is there already:" + given +
                             (given.starts_with(" --device") ? " has no use" : " chooses one of a scene"));
        return [file = scene.file, &library](Notes& notes) {
            return std::make_unique<view::CubeSubject>(file, library, notes);
        };
    }
    return [load = loadOptions(scene), settings = renderSettings(scene), file = scene.file,
            device = Device::open(deviceNumber(scene.device)), &library](Notes& notes) {
        return std::make_unique<view::SceneSubject>(file, load, settings, device, library, notes);
    };
}

/// Of the window or frame, in pixels: --size, else the picture's own; a cube's as far as it is handy.
std::pair<int, int> sizeOf(const ViewArguments& arguments, view::Session& session, bool offscreen) {
    const view::Subject& subject = session.about();
    if (session.aboutScene()) return {subject.width(), subject.height()};
    if (!arguments.scene.size.empty()) return parseSize("--size", arguments.scene.size);
    constexpr int largestFrame = 8192;  // pixels a side that OpenGL draws into anywhere
    if (offscreen) return {std::min(subject.width(), largestFrame), std::min(subject.height(), largestFrame)};
    return {std::clamp(subject.width(), 960, 1600), std::clamp(subject.height(), 640, 1000)};
}

ExitCode show(const ViewArguments& arguments) {
    Console console(arguments.quiet);
    const bool offscreen = !arguments.offscreen.empty();
    std::optional<int> frames;
    if (!arguments.frames.empty())
        frames = parseCount("--frames", arguments.frames, 0, std::numeric_limits<int>::max());
    if (offscreen) {
        if (extensionOf(arguments.offscreen) != ".png")
            throw UsageError("--offscreen: '" + arguments.offscreen + "' must end in .png");
        requireOther("--offscreen", arguments.offscreen, arguments.scene.file);
        requireWritable(arguments.offscreen);
        if (!frames) frames = 0;
    }
    std::vector<view::Action> actions;
    if (!arguments.script.empty()) actions = view::parseScript(readFile(arguments.script), arguments.script);

    const Library library = Library::open();
    view::Session session(openerOf(arguments, library), library, console.notes(), arguments.scene.restricted);
    console.printNotes();
    session.software = "Spectrad " SPECTRAD_VERSION;
    session.waits = offscreen;
    const auto [width, height] = sizeOf(arguments, session, offscreen);
    const std::unique_ptr<view::Face> face =
        offscreen ? view::openOffscreen(width, height)
                  : view::openWindow(width, height, "Spectrad: " + arguments.scene.file);
    view::Viewer viewer(*face, session);
    viewer.showPanels(!arguments.plain);
    view::run(viewer, actions, frames);
    if (offscreen) writePng(arguments.offscreen, viewer.picture());
    return ExitCode::ok;
}

}  // namespace

void addView(CLI::App& app, Action& action) {
    CLI::App* command =
        app.add_subcommand("view", "Look at a scene or a cube: other lights, materials, observers at once");
    auto arguments = std::make_shared<ViewArguments>();
    command
        ->add_option("SCENE", arguments->scene.file,
                     "scene of Spectrad, a model of another program, or a spectral image (EXR, ENVI)")
        ->type_name("SCENE|CUBE")
        ->required();
    addSceneOptions(*command, arguments->scene);
    addDeviceOption(*command, arguments->scene.device);
    command
        ->add_option("--offscreen", arguments->offscreen,
                     "no window: draw in memory, and write the last frame, panels and all, as a picture")
        ->type_name("OUT.png");
    command
        ->add_option("--script", arguments->script,
                     "play these actions first, one a line (docs/format.md, \"view\")")
        ->type_name("FILE");
    command
        ->add_option("--frames", arguments->frames,
                     "frames to go on for; default: until closed, off screen 0")
        ->type_name("N");
    command->add_flag("--plain", arguments->plain, "no panels at first (the tab key brings them)");
    command->add_flag("-q,--quiet", arguments->quiet, "no remarks on standard error");
    command->footer(
        "Colours are those of the exact spectra, as 'render' and 'observe' make them; spectra under the "
        "pointer are on "
        "the scene's bands, as 'measure' gives them. Exposure is measured once and then held (E measures "
        "again). H "
        "shows the keys.\n\n"
        "Examples:\n"
        "  spectrad view scene.xml\n"
        "  spectrad view cube.exr\n"
        "  spectrad view scene.xml --offscreen view.png --size 1280x720\n"
        "  spectrad view scene.xml --offscreen view.png --script actions.txt --frames 3");
    command->final_callback([&action, arguments] { action = [arguments] { return show(*arguments); }; });
}

}  // namespace spectrad
