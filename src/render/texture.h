// Spectral textures: reflectances or radiances, linear between the wavelengths that all texels share.
#pragma once

#include "image/cube.h"
#include "image/picture_values.h"
#include "opencl/device.h"
#include "scene/scene.h"
#include "spectrum/library.h"

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace spectrad {

/// An image of any number of bands.
struct Texels {
    int width = 0, height = 0, bands = 1;
    std::vector<float> texels;  ///< [(row * width + column) * bands + band], row 0 on top
};

struct ResidentTexels;
struct SpectralTexture {
    int width = 0, height = 0;
    std::vector<double> nm;                            ///< ascending
    std::vector<float> texels;                         ///< [(row * width + column) * nm + band], row 0 on top
    std::shared_ptr<const ResidentTexels> resident{};  ///< instead of them, on the device

    /// For who wants to look at the texels: brings them to the host. Throws MachineError.
    void fetch();
};

/// Of each band the mean over all pixels.
[[nodiscard]] std::vector<double> meanOfTexels(const std::vector<float>& texels, size_t bands);

/// A cube as a texture: slit averages become the nodal values of the curve that has them; reflectances are
/// held at or above zero, radiances keep their sign so that the same bands come back. Throws InputError for a
/// cube of another kind than the use asks for (only radiance carries fluorescence; only a reflectance takes a
/// lamp).
[[nodiscard]] SpectralTexture textureFrom(const Cube& cube, const TextureUse& use, Notes& notes);
/// The same of a pass that stays on the device.
[[nodiscard]] SpectralTexture textureFrom(std::shared_ptr<const ResidentTexels> image, const TextureUse& use,
                                          Notes& notes);
/// Of its file, or of the bytes inside a model. Throws InputError.
[[nodiscard]] PictureValues valuesOf(const TextureUse& use);
[[nodiscard]] bool isPicture(const TextureUse& use);

/// Where textures come from: files here, passes by whoever can render them.
class TextureLoader {
  public:
    TextureLoader(const Scene& scene, const Library& library, Notes& notes)
        : scene_(scene), library_(library), notes_(notes) {}
    virtual ~TextureLoader() = default;
    TextureLoader(const TextureLoader&) = delete;
    TextureLoader& operator=(const TextureLoader&) = delete;

    /// Textures are refused, before they are read, that this device does not take in one piece.
    void limitTo(const DeviceInfo& device) { device_ = device; }

    /// Throws InputError at the use's place.
    [[nodiscard]] SpectralTexture load(const TextureUse& use);

  protected:
    /// What a plan needs to know of a pass without rendering it: one black texel on the pass's wavelengths.
    [[nodiscard]] virtual SpectralTexture loadPass(const Pass& pass, const TextureUse& use);
    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] const Library& library() const { return library_; }
    [[nodiscard]] Notes& notes() { return notes_; }

  private:
    void checkFits(const TextureUse& use, int width, int height, size_t bands) const;

    const Scene& scene_;
    const Library& library_;
    Notes& notes_;
    std::optional<DeviceInfo> device_;
};

}  // namespace spectrad
