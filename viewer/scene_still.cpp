// The spectra of a scene's picture: the terms of a pixel, each with its own spectrum on the scene's bands.
#include "spectrum/projection.h"
#include "viewer/scene_subject.h"

#include <cmath>

namespace spectrad::view {

class SceneSubject::SceneStill : public Still {
  public:
    SceneStill(std::shared_ptr<const Eye> eye, std::shared_ptr<const Table> terms, Device reader,
               std::shared_ptr<const SeenTerms> seen, Wavelengths grid, int width, int height)
        : Still(std::move(eye)),
          terms_(std::move(terms)),
          reader_(std::move(reader)),
          seen_(std::move(seen)),
          grid_(std::move(grid)),
          width_(width),
          height_(height) {}

    [[nodiscard]] std::vector<double> spectrumAt(int x, int y) override {
        if (x < 0 || y < 0 || x >= width_ || y >= height_) return {};
        std::vector<float> sum(grid_.size(), 0.0f);
        for (const auto& [term, g] : seen_->at(reader_, x, y)) {
            const std::vector<float> bands = bandsOf(term);
            // The same sums as kernels/expand.cl.
            for (size_t band = 0; band < sum.size(); ++band)
                sum[band] = std::fma(bands[band], g, sum[band]);
        }
        return {sum.begin(), sum.end()};
    }
    [[nodiscard]] DetectorWeights weights() const override { return weightsOn(grid_, eye().detector); }

  private:
    [[nodiscard]] std::vector<float> bandsOf(std::uint32_t term) const {
        const Table& terms = *terms_;
        const TermRecipe& recipe = terms.recipes.at(term);
        if (recipe.group == TermRecipe::unknown) {
            const auto from = terms.spectra.begin() + static_cast<std::ptrdiff_t>(term * grid_.size());
            return {from, from + static_cast<std::ptrdiff_t>(grid_.size())};
        }
        std::vector<const Curve*> product;
        double factor = recipe.factor;
        if (recipe.group != TermRecipe::none) {
            product.push_back(&terms.groups.at(recipe.group).spectrum);
            factor *= terms.groups[recipe.group].factor;
        }
        for (const Curve& curve : recipe.response)
            product.push_back(&curve);
        std::vector<float> bands;
        for (double value : project(grid_, product))
            bands.push_back(static_cast<float>(value * factor));
        return bands;
    }

    std::shared_ptr<const Table> terms_;
    Device reader_;
    std::shared_ptr<const SeenTerms> seen_;
    Wavelengths grid_;
    int width_, height_;
};

std::shared_ptr<Still> SceneSubject::still(const Look& look) {
    std::shared_ptr<const Table> terms = table(look);
    resolve();
    return std::make_shared<SceneStill>(look.eye, std::move(terms), reader_, live_->seen(), wavelengths_,
                                        view_.width, view_.height);
}

}  // namespace spectrad::view
