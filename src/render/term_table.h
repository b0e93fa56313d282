// The spectra of terms: light × lobe of a material, on the output's bands and for the preview. The table has
// no position in it.
#pragma once

#include "render/anisotropy.h"
#include "render/coat.h"
#include "render/light_groups.h"
#include "render/settings.h"
#include "render/texture.h"
#include "render/world.h"
#include "scene/scene.h"
#include "spectrum/wavelengths.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace spectrad {

struct Eye;
struct Detector;
struct Entry;

/// How a term depends on the light: a light's spectrum times one curve times a number; or on no light; or in
/// a way that only the material knows (fluorescence), when `group` is `unknown`.
struct TermRecipe {
    static constexpr std::uint32_t none = 0xffffffff, unknown = 0xfffffffe;
    std::uint32_t group = none;   ///< light group
    std::vector<Curve> response;  ///< factors of the term's spectrum beside the light's
    double factor = 1;            ///< to be multiplied by the group's
};

/// The term's preview for another spectrum or amount of its light, or another eye: three integrals, no bands.
/// Throws InputError where it is beyond the range of float.
[[nodiscard]] std::array<float, 3> relit(const TermRecipe& recipe, const LightGroup& group, const Eye& eye);

/// c of L(x, λ) = Σ g(x) c(λ). Unit of c times unit of g is W·m⁻²·sr⁻¹·nm⁻¹ (g: 1, or 1/m² under point
/// lights).
struct TermTable {
    size_t bands = 0;
    std::vector<float> spectra;       ///< [term][band]
    std::vector<float> preview;       ///< [term][3]: linear Rec.709 of the exact spectrum, bands do not enter
    std::vector<TermRecipe> recipes;  ///< [term]
    /// For references, where RenderSettings::exact asks for them: the spectra before they became float, and
    /// that detector's channels of the exact spectrum, [term][channel]; bands do not enter.
    std::vector<double> exactSpectra, exactChannels;
    [[nodiscard]] size_t count() const { return preview.size() / 3; }
};

/// Part of a term's spectrum: factor × the product of the curves.
struct Summand {
    std::vector<const Curve*> product;
    double factor = 1;
};

/// Appends materials' lobes to a world and the lobes' terms to a table. The order of terms is
/// [lobe][function][light group].
class TermBuilder {
  public:
    /// `exact`: who sees the table's exact channels; nobody: none are kept.
    TermBuilder(const Wavelengths& grid, const Eye& eye, std::vector<LightGroup> groups, Only only,
                TextureLoader& textures, World& world, TermTable& terms, Notes& notes,
                const Detector* exact = nullptr);

    /// Material 0 of the world; without a background it has no terms.
    void addBackground(const Emitter* background, double factor);
    /// The same with a picture behind everything.
    void addBackdrop(const TextureUse& use, double factor);
    /// Returns the world's number of the material. Throws InputError for combinations that have no meaning,
    /// and for what is not there yet.
    std::uint32_t add(const Material& material, double emissionFactor);

    /// Warns of band values that float cannot hold, unless they are nothing beside their term's largest.
    void noteLost() const;

    [[nodiscard]] const std::vector<LightGroup>& groups() const { return groups_; }

  private:
    /// `clip`: bands below zero (signed noise of a measurement) become zero, and are counted in the notes.
    /// `glows`: some of it is excited by the light, which no recipe knows.
    void addTerm(const std::vector<Summand>& sum, bool clip = false, bool glows = false);
    void addExact(const std::vector<Summand>& sum, const std::vector<double>& bands);
    /// Once per group: light × response.
    void addGroupTerms(const Curve& response, double factor = 1);
    std::uint32_t beginMaterial();
    [[nodiscard]] sd_lobe beginLobe(int type) const;
    void endLobe(const sd_lobe& lobe);
    std::uint32_t addTables(const std::vector<std::vector<sd_piece>>& tables);
    /// Tables of a function's coefficients.
    static std::vector<std::vector<sd_piece>> tablesOf(const DirectionFunction& function);
    static void setWidths(sd_lobe& lobe, Widths widths);

    /// Images in the world, each once however often it is used: 1 + its number, the wavelengths of its bands.
    struct Image {
        std::uint32_t number = 0;
        std::vector<double> nm;
    };
    /// How a coat passes light in one direction.
    struct Passage {
        const Curve* weight = nullptr;  ///< one more factor of the spectrum
        std::uint32_t table = 0;
        double meanThrough = 1, inside = 0;
    };
    /// What the diffuse part of a material lies under.
    struct Base {
        int type = SD_LOBE_DIFFUSE;  ///< or SD_LOBE_COATED
        Passage in, out;             ///< alike for all that is reflected
        Widths widths = 0;           ///< the coat's
        double index = 1;            ///< the coat's; 1 where it is not known
        bool reflects = true;        ///< false: other lobes do, only what glows is asked for
        bool glows = true;           ///< false: other lobes do
        double glowShare = 1;        ///< of what fluorophores would send out
    };
    void addBase(const Material& material, const Base& base);
    void addTexturedBase(const Material& material, const Base& base);
    void addTexturedGlow(const Material& material, const Base& base, const Image& image);
    /// Of the spectra of what a base sends out.
    [[nodiscard]] static double glowFactor(const Base& base, const LightGroup& group);
    /// Oren–Nayar's part of a base, its term's factors included; what glows is left to addBase().
    void addRough(const Material& material, Base& base, const DirectionFunction& through);
    [[nodiscard]] sd_lobe beginBase(const Base& base) const;
    [[nodiscard]] static Entry entryOf(const Base& base);
    void addBaseTerm(const Base& base, const LightGroup& group, const std::vector<Curve>& reflected,
                     const std::vector<Curve>& glow, double sign = 1);
    void addGloss(const Material& material);
    void addSpecular(const Material& material);
    void addConductor(const Material& material);
    void addGlowing(const TextureUse& use, double factor);
    const Image& spectralTexture(const TextureUse& use);
    std::uint32_t strengthTexture(const TextureUse& use);
    std::uint32_t shareTexture(const Select& select);
    std::uint32_t reliefTexture(const Relief& relief);
    /// Diffuse base under a coat, its terms weighted by `weight` (one factor of the spectrum).
    void addCoatedBase(const Material& material, const Curve& weight, const Coat& coat, Widths widths,
                       bool glows);
    /// Where exciting light comes through a coat otherwise than what is emitted gets out; `number`: the
    /// coat's, see CoatModel.
    [[nodiscard]] bool glowsApart(const Material& material, const Curve& number) const;
    /// What such a base's fluorophores send out, whose terms belong to a value of the number for light on its
    /// way in and one on its way out.
    void addCoatedGlow(const Material& material, CoatModel model, const Curve& number, Widths widths);
    void addFacets(const std::vector<AngleFunction>& fresnel, const std::vector<Curve>& spectra,
                   Widths widths, const std::optional<TextureUse>& reflects);
    void addReflection(const TextureUse& use, const std::vector<AngleFunction>& fresnel,
                       const std::vector<Curve>& spectra);

    const Wavelengths& grid_;
    WavelengthSpan anyone_;  ///< wavelengths that terms are right at
    const Eye& eye_;
    std::vector<LightGroup> groups_;
    Only only_;
    TextureLoader& textures_;
    World& world_;
    TermTable& terms_;
    Notes& notes_;
    const Detector* exact_;
    size_t lost_ = 0;
    std::map<std::string, Image> images_;  ///< by what they are and how they lie
};

}  // namespace spectrad
