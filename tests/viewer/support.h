// A scene in a viewer off screen, within the test's process.
#pragma once

#include "image/cube.h"
#include "spectrum/library.h"
#include "support/temporary_folder.h"
#include "viewer/viewer.h"

#include <memory>
#include <string>

namespace spectrad::view::test {

/// False, and said, where no OpenCL device or no OSMesa is.
[[nodiscard]] bool canView();

/// Lambert, a coat, a metal and fluorescence under two lamps, 96 x 64 pixels.
[[nodiscard]] const std::string& smallScene();

/// All that a viewer needs, in the order in which it goes.
class Desk {
  public:
    explicit Desk(const std::string& sceneText, RenderSettings settings = {});
    /// A scene or cube that is there already.
    explicit Desk(const std::filesystem::path& file, RenderSettings settings = {});
    Desk(const Desk&) = delete;
    Desk& operator=(const Desk&) = delete;

    /// Plays a script.
    void play(const std::string& script);
    /// Paints what is wished for; false if that is there already.
    bool refresh(Codes& left, Codes& right) const;
    /// Look A's spectrum and colour, with as many samples as there are.
    [[nodiscard]] Pin measured(int x, int y) const;

    TemporaryFolder folder;
    Notes notes;
    Library library;
    Device device;
    std::unique_ptr<Session> session;
    std::unique_ptr<Face> face;
    std::unique_ptr<Viewer> viewer;

  private:
    void open(const std::filesystem::path& file, const RenderSettings& settings);
};

/// A scene's own cube, as render makes it, passes and all.
[[nodiscard]] Cube rendered(const std::string& text, const Desk& desk, RenderSettings settings = {});
/// The largest ΔE00 between the viewer's float colours (look A, 16 samples) and those of the rendered scene,
/// seen through its bands, as observe does.
[[nodiscard]] double worstDifference(Desk& desk, const std::string& text, RenderSettings settings = {});
/// With the first `what` replaced, which must be there.
[[nodiscard]] std::string replaced(std::string text, const std::string& what, const std::string& by);

}  // namespace spectrad::view::test
