// A material's bidirectional reflectance in double precision, from the plan's lobes, tables and terms.
#pragma once

#include "base/vec.h"
#include "render/plan.h"

namespace spectrad::test {

/// Of material 1 (the first that is worn) of a plan whose one light group has irradiance 1 in every band.
class Reflectance {
  public:
    Reflectance(const Plan& plan, size_t material, size_t band)
        : plan_(plan), material_(plan.world.materials.at(material)), band_(band) {}

    /// f(view, light), 1/sr; both unit vectors on the side of the normal (0, 0, 1), texture coordinates' u
    /// along x.
    [[nodiscard]] double operator()(Vec3 view, Vec3 light) const {
        return facets(view, light) + others(view, light);
    }
    /// What uniform light from everywhere becomes: the tables' own sum.
    [[nodiscard]] double albedo(Vec3 view) const;
    /// ∫ f(view, light) cos θ dω by quadrature: half vectors for the facets' single scattering, directions
    /// for the rest.
    [[nodiscard]] double integral(Vec3 view) const;

  private:
    [[nodiscard]] double facets(Vec3 view, Vec3 light) const;  ///< single scattering
    [[nodiscard]] double others(Vec3 view, Vec3 light) const;
    [[nodiscard]] double facetsOf(const sd_lobe& lobe, Vec3 view, Vec3 light) const;
    /// Function `number` of a lobe in a direction; u is along x.
    [[nodiscard]] double function(const sd_lobe& lobe, size_t number, Vec3 direction) const;
    /// Below the coat of a rough base: the direction, and its tables.
    struct Below {
        double cosine, missing, back;
    };
    [[nodiscard]] Below below(const sd_lobe& lobe, double cosine) const;
    [[nodiscard]] double fresnel(const sd_lobe& lobe, size_t number, double cosine) const;
    [[nodiscard]] double term(const sd_lobe& lobe, size_t function) const;

    const Plan& plan_;
    const sd_material& material_;
    size_t band_;
};

}  // namespace spectrad::test
