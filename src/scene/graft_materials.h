// Imported materials as materials of a scene: RGB lifted to spectra, bindings obeyed.
#pragma once

#include "scene/graft.h"
#include "scene/graft_pictures.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace spectrad {

/// The model's file, for remarks about it.
[[nodiscard]] SourceLocation fileLocation(const ImportedScene& model);

/// Share of linear sRGB white's luminance (IEC 61966-2-1).
[[nodiscard]] double luminanceShare(const std::array<double, 3>& linearSrgb);
/// The shape of a lamp's spectrum; the brightness goes into its amount.
[[nodiscard]] Spectrum colourOfLamp(std::array<double, 3> linearSrgb, const SpectrumResolver& resolver,
                                    const SourceLocation& where);

/// Whether `text` is what `pattern` stands for: * any run of characters, ? any one.
[[nodiscard]] bool matches(std::string_view pattern, std::string_view text);

/// Adds materials to the scene as meshes ask for them, each once; those that nothing wears stay out.
class GraftedMaterials {
  public:
    GraftedMaterials(Scene& scene, const ImportedScene& model, const GraftOptions& options,
                     const SpectrumResolver& resolver, SourceLocation where);

    [[nodiscard]] Index of(std::uint32_t imported);
    void warnOfIdleBindings(Notes& notes) const;
    /// What became of the pictures that worn materials name.
    void warnOfPictures(Notes& notes) const { pictures_.warn(notes); }

  private:
    [[nodiscard]] Material lifted(const ImportedMaterial& from);
    [[nodiscard]] Spectrum reflectance(const std::array<double, 3>& linearSrgb);
    [[nodiscard]] std::string uniqueName(const std::string& name) const;

    Scene& scene_;
    const ImportedScene& model_;
    const GraftOptions& options_;
    const SpectrumResolver& resolver_;
    SourceLocation where_;
    GraftedPictures pictures_;
    std::vector<std::optional<Index>> number_;          ///< of each imported material, once it is known
    std::map<std::array<double, 3>, Spectrum> lifted_;  ///< lifting is a fit: done once for each colour
};

}  // namespace spectrad
