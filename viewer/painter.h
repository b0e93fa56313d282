// Wishes become pictures. A painter has the subject; whoever holds the painter – the window's thread, or the
// one that a painting is being made on – is the only one to call it.
#pragma once

#include "colour/difference.h"
#include "spectrum/resolver.h"
#include "viewer/subject.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace spectrad::view {

/// A picture that is ready, and the wish that it answers.
struct Painting {
    Wish wish;                  ///< with the luminance held and the bands' whites as they came out
    int width = 0, height = 0;  ///< of the codes
    Codes left, right;          ///< in a split both
    std::optional<ColourDifference> difference;    ///< of a map, without the map itself
    std::array<std::shared_ptr<Still>, 2> stills;  ///< of the looks; only of pictures with all their samples
};

class Painter {
  public:
    /// `restricted`: no file outside the subject's folder but the library's.
    Painter(std::unique_ptr<Subject> subject, const Library& library, bool restricted);

    [[nodiscard]] Subject& subject() { return *subject_; }
    /// What never changes of the subject, for any thread.
    [[nodiscard]] const Subject& about() const { return *subject_; }

    /// Into `painting`, whose memory is used again. Throws InputError, UsageError, MachineError, and Stopped
    /// when it is asked to stop.
    void paint(const Wish& wish, Painting& painting, const std::stop_token& stop = {});

    [[nodiscard]] White whiteOf(const Wish& wish, const Look& look);
    /// XYZ of all pixels, absolute; of a film what its projector shows.
    [[nodiscard]] ChannelImage seen(const Wish& wish, const Look& look);
    /// The luminance, cd/m², that is shown as display white before ± EV, from the picture as observe does.
    [[nodiscard]] double measuredLuminance(const Wish& wish);

  private:
    [[nodiscard]] Rendering rendering(const Wish& wish, const Look& look);
    [[nodiscard]] Rendering mixedRendering(const Wish& wish);
    [[nodiscard]] Shown shown(const Wish& wish, const Look& look, const Rendering& how);
    [[nodiscard]] ChannelImage developed(const Wish& wish, const Look& look, ChannelImage channels);
    void paintLook(const Wish& wish, const Look& look, Codes& codes);
    void paintMixture(const Wish& wish, Codes& codes);
    void paintBands(Painting& painting);
    void paintDifference(Painting& painting);

    std::unique_ptr<Subject> subject_;
    Notes unsaid_;
    SpectrumResolver resolver_;
    std::shared_ptr<const Eye> standard_;  ///< CIE 1931
};

}  // namespace spectrad::view
