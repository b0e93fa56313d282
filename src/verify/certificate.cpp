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
    return withLuminance({plan.labWhiteName, plan.labWhite, false}, luminance);
}

namespace {

/// How far pixels of an image are from what they should be.
class Judge {
  public:
    Judge(const PixelSample& sample, const White& white) : sample_(sample), white_(white) {}

    void hold(size_t pixel, const ReferencePixel& right) {
        colour.push_back(deltaE00(lab(right.xyz, white_.xyz), lab(sample_.xyzOf(pixel), white_.xyz)));
        double most = 0;
        for (size_t band = 0; band < right.bands.size(); ++band) {
            const double off = std::abs(sample_.bandsOf(pixel)[band] - right.bands[band]),
                         largest = sample_.largest()[band];
            // A band that is black all over in the image takes the reference as its measure.
            if (off > 0) most = std::max(most, off / (largest > 0 ? largest : right.bands[band]));
        }
        bands.push_back(most);
    }

    std::vector<double> colour, bands;

  private:
    const PixelSample& sample_;
    const White& white_;
};

}  // namespace

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

    // A random share of pixels drawn at random is one of the image's pixels.
    const std::vector<std::uint64_t> few = drawn(out.pixels, mostAreaPixels, out.seed);
    out.areaPixels = few.size();
    std::vector<PixelPlace> whole;
    for (std::uint64_t pixel : few)
        whole.push_back(sample.places()[pixel]);
    const double work = static_cast<double>(out.pixels) * referenceSamples,
                 more = static_cast<double>(few.size()) * areaSamples;
    const auto share = [&](double from, double of) {
        return [&progress, from, of, all = work + more](double done) {
            if (progress) progress((from + of * done) / all);
        };
    };
    const std::vector<ReferencePixel> right = reference.at(sample.places(), referenceSamples, share(0, work)),
                                      fine = reference.at(whole, areaSamples, share(work, more));
    Judge judge(sample, white), areas(sample, white);
    for (size_t i = 0; i < right.size(); ++i)
        judge.hold(i, right[i]);
    for (size_t i = 0; i < fine.size(); ++i)
        areas.hold(few[i], fine[i]);
    const auto worst = std::max_element(judge.colour.begin(), judge.colour.end());
    out.worst = sample.places()[static_cast<size_t>(worst - judge.colour.begin())];
    const auto all = [&](std::vector<double> values) {
        return estimate(std::move(values), out.population, certificateConfidence);
    };
    out.colour = all(std::move(judge.colour));
    out.bands = all(std::move(judge.bands));
    out.areaColour = all(std::move(areas.colour));
    out.areaBands = all(std::move(areas.bands));
    return out;
}

}  // namespace spectrad
