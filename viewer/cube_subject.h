// A cube that is there already: a look costs its projection, three numbers a pixel; the bands stay in the
// file where they are many.
#pragma once

#include "image/cube_reader.h"
#include "spectrum/library.h"
#include "spectrum/resolver.h"
#include "viewer/subject.h"

#include <array>
#include <memory>

namespace spectrad::view {

class CubeSubject : public Subject {
  public:
    /// A cube of at most `mostHeld` bytes is kept in memory, a larger one is read anew in strips. Throws
    /// InputError.
    CubeSubject(const std::filesystem::path& file, const Library& library, Notes& notes,
                size_t mostHeld = size_t{1} << 30);
    ~CubeSubject() override;

    [[nodiscard]] const CubeInfo& info() const { return reader_->info(); }
    /// Draws bands; fills in `picture.white`.
    void showBands(BandPicture& picture, Codes& codes);

    [[nodiscard]] std::filesystem::path file() const override { return file_; }
    [[nodiscard]] std::vector<std::filesystem::path> files() const override;
    /// A ratio has one light, which shines on it; a radiance has its own already.
    [[nodiscard]] Look firstLook() const override { return first_; }
    [[nodiscard]] int width() const override { return info().width; }
    [[nodiscard]] int height() const override { return info().height; }
    [[nodiscard]] const Wavelengths& wavelengths() const override { return info().wavelengths; }
    [[nodiscard]] CubeKind kind() const override { return info().kind; }
    void show(const Look& look, const Shown& shown, Codes& codes) override;
    void showMixed(const Look& a, const Look& b, double mix, const Shown& shown, Codes& codes) override;
    [[nodiscard]] ChannelImage xyz(const Look& look) override;
    [[nodiscard]] std::shared_ptr<Still> still(const Look& look) override;
    [[nodiscard]] White white(const Look& look) override;
    [[nodiscard]] double whiteAmount(const Look& look) override;

  private:
    class CubeStill;
    struct MeterRow;
    struct Projection {
        std::string light;  ///< by its text; empty: the cube's own
        std::shared_ptr<const Eye> eye;
        ChannelImage xyz;
    };
    struct Plane {
        size_t band = 0;
        std::vector<float> values;
        double top = 0;  ///< 99th percentile
    };
    /// XYZ with the light as it is, times = 1.
    [[nodiscard]] const ChannelImage& projected(const Look& look);
    [[nodiscard]] const Plane& plane(size_t band);
    /// The strip that holds a row, from memory or from the file.
    [[nodiscard]] const float* row(int y);
    [[nodiscard]] bool lit() const;
    [[nodiscard]] DetectorWeights weights(const Look& look) const;

    // Of its opening:
    std::filesystem::path file_;
    Eye standard_;
    std::unique_ptr<CubeReader> reader_;
    Look first_;
    std::shared_ptr<MeterRow> meter_;  ///< the stills'; nothing where the whole cube is held

    // The holder's:
    Notes unsaid_;  ///< what there is to say was said when the cube was opened
    SpectrumResolver resolver_;
    std::shared_ptr<std::vector<float>>
        held_;  ///< rows [heldFrom_, heldTo_); all of them: never written again
    int heldFrom_ = 0, heldTo_ = 0, stripRows_ = 1;
    std::vector<Projection> projections_;  ///< the last two looks'
    std::vector<Plane> planes_;            ///< the last three bands'
};

}  // namespace spectrad::view
