// The spectra of terms: light × lobe of a material, on the output's bands and for the preview. The table has no position in it.
#pragma once

#include "render/light_groups.h"
#include "render/world.h"
#include "scene/scene.h"
#include "spectrum/wavelengths.h"

#include <cstdint>
#include <vector>

namespace spectrad {

struct Detector;

/// c of L(x, λ) = Σ g(x) c(λ). Unit of c times unit of g is W·m⁻²·sr⁻¹·nm⁻¹ (g: 1, or 1/m² under point lights).
struct TermTable {
    size_t bands = 0;
    std::vector<float> spectra;  ///< [term][band]
    std::vector<float> preview;  ///< [term][3]: linear Rec.709 of the exact spectrum, bands do not enter
    [[nodiscard]] size_t count() const { return preview.size() / 3; }
};

/// What a scene material needs: its lobes and terms, appended to world and table.
class TermBuilder {
  public:
    TermBuilder(const Wavelengths& grid, const Detector& observer, std::vector<LightGroup> groups, World& world,
                TermTable& terms);

    /// Material 0 of the world; without a background it has no terms.
    void addBackground(const Emitter* background, double factor);
    /// Returns the world's number of the material. Throws InputError for lobes that are not there yet.
    std::uint32_t add(const Material& material, double emissionFactor);

  private:
    void addTerm(std::vector<const Curve*> product, double factor);
    void addGroupTerms(const Curve& response);
    std::uint32_t beginMaterial();
    sd_lobe beginLobe(int type) const;
    void endLobe(const sd_lobe& lobe);
    void addCoat(const Gloss& gloss, const Curve& base);

    const Wavelengths& grid_;
    const Detector& observer_;
    std::vector<LightGroup> groups_;
    World& world_;
    TermTable& terms_;
};

}  // namespace spectrad
