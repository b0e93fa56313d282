#include "verify/certificate.h"

#include "colour/display.h"
#include "render/passes.h"
#include "render/renderer.h"

#include <fmt/format.h>

#include <Imath/half.h>
#include <algorithm>
#include <cmath>

namespace spectrad {

PixelSample::PixelSample(const CubeInfo& info, double share, std::uint64_t seed, const Detector& observer,
                         bool asHalf)
    : info_(info),
      seed_(seed),
      weights_(weightsOn(info.wavelengths, observer)),
      asHalf_(asHalf),
      largest_(info.wavelengths.size(), 0.0) {
    const auto width = static_cast<std::uint64_t>(info.width),
               all = width * static_cast<std::uint64_t>(info.height);
    const auto wanted = static_cast<std::uint64_t>(std::llround(share * static_cast<double>(all)));
    for (std::uint64_t number : drawn(all, std::max<std::uint64_t>(wanted, fewestPixels), seed))
        places_.push_back({static_cast<int>(number % width), static_cast<int>(number / width)});
    bands_.resize(places_.size());
}

void PixelSample::add(int firstRow, int rows, const float* bands) {
    const size_t count = info_.wavelengths.size(), width = static_cast<size_t>(info_.width);
    std::vector<float> row(count * width);
    ChannelImage xyz(info_.width, 1, 3);
    for (int y = 0; y < rows; ++y) {
        std::copy_n(bands + static_cast<size_t>(y) * row.size(), row.size(), row.data());
        if (asHalf_)
            for (float& value : row)
                value = static_cast<float>(Imath::half(value));
        observeRow(weights_, row.data(), 0, xyz);
        brightest_ = std::max(brightest_, *std::max_element(xyz.plane[1].begin(), xyz.plane[1].end()));
        for (size_t band = 0; band < count; ++band)
            for (size_t x = 0; x < width; ++x)
                largest_[band] = std::max(largest_[band], std::abs(double{row[band * width + x]}));
        for (; next_ < places_.size() && places_[next_].y == firstRow + y; ++next_)
            for (size_t band = 0; band < count; ++band)
                bands_[next_].push_back(row[band * width + static_cast<size_t>(places_[next_].x)]);
    }
}

Triple PixelSample::xyzOf(size_t pixel) const {
    Triple xyz{};
    for (size_t c = 0; c < 3; ++c)
        for (size_t band = 0; band < bands_[pixel].size(); ++band)
            xyz[c] += weights_.weights[c][band] * bands_[pixel][band];
    return xyz;
}

White defaultWhite(const Scene& scene, const RenderSettings& settings, const Detector& observer,
                   const Library& library, const Device& device, double brightest) {
    const Eye eye{observer, towardsXyz(observer, observer)};
    RenderSettings white = settings;
    white.substitute = Substitute::irradiance;
    white.samples = 1;
    white.wavelengths = Wavelengths{{560}, Projection::slit, 5};
    white.projection.reset();
    white.eye = &eye;
    Notes unheard;
    PassTextures passes(scene, library, device, settings, unheard);
    const Plan plan = makePlan(scene, white, library, passes, unheard);
    double diffuse = 0;
    const Matrix3 toXyz = srgbDisplay().toXyz;
    Renderer renderer(device, plan);
    renderer.render([&](int, int rows, const float*, const float* linear) {
        const auto width = static_cast<size_t>(plan.view.width);
        for (size_t row = 0; row < static_cast<size_t>(rows); ++row)
            for (size_t x = 0; x < width; ++x) {
                const float* rgb = linear + row * 3 * width + x;
                const Triple xyz = toXyz * Triple{rgb[0], rgb[width], rgb[2 * width]};
                diffuse = std::max(diffuse, luminousEfficacy * xyz[1]);
            }
    });
    const double luminance = diffuse > 0 ? std::min(brightest, diffuse) : brightest;
    if (!(luminance > 0)) throw InputError("the image is black: there is no white for a colour difference");
    return withLuminance({plan.whiteName, plan.white, false}, luminance);
}

Certificate certify(const PixelSample& sample, const Reference& reference, const Detector& observer,
                    const White& white, const Progress& progress) {
    const CubeInfo& info = sample.info();
    if (info.width != reference.width() || info.height != reference.height())
        throw InputError(fmt::format("the image has {} x {} pixels, the scene's picture {} x {}", info.width,
                                     info.height, reference.width(), reference.height()));
    Certificate out;
    out.observer = observer.name;
    out.white = white;
    out.seed = sample.seed();
    out.pixels = sample.places().size();
    out.population = static_cast<size_t>(info.width) * static_cast<size_t>(info.height);
    out.taken = reference.taken();
    const std::vector<ReferencePixel> right = reference.at(sample.places(), progress);
    std::vector<double> colour, bands;
    double worst = -1;
    for (size_t i = 0; i < right.size(); ++i) {
        const double difference = deltaE00(lab(right[i].xyz, white.xyz), lab(sample.xyzOf(i), white.xyz));
        if (difference > worst) {
            worst = difference;
            out.worst = sample.places()[i];
        }
        colour.push_back(difference);
        double most = 0;
        for (size_t band = 0; band < right[i].bands.size(); ++band) {
            const double off = std::abs(sample.bandsOf(i)[band] - right[i].bands[band]);
            // A band that is black all over in the image takes the reference as its measure.
            const double scale =
                std::max(sample.largest()[band], sample.largest()[band] > 0 ? 0 : right[i].bands[band]);
            if (off > 0) most = std::max(most, off / scale);
        }
        bands.push_back(most);
    }
    out.colour = estimate(std::move(colour), out.population, certificateConfidence);
    out.bands = estimate(std::move(bands), out.population, certificateConfidence);
    return out;
}

}  // namespace spectrad
