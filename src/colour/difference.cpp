#include "colour/difference.h"

#include "base/text.h"
#include "colour/develop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace spectrad {

static constexpr size_t blockSize = 64;  // pixels whose bands stay in the cache for a second look

BandDifferenceMeter::BandDifferenceMeter(size_t bands, int width)
    : bands_(bands), width_(static_cast<size_t>(width)), largestDifference_(bands), largestA_(bands) {}

void BandDifferenceMeter::add(const float* a, const float* b) {
    // Lanes that run along x side by side, so that the compiler may use vectors; each keeps its own sum and
    // maxima.
    constexpr size_t lanes = 16;
    double rowSquares = 0;
    for (size_t j = 0; j < bands_; ++j) {
        const float *bandA = a + j * width_, *bandB = b + j * width_;
        std::array<double, lanes> squares{}, difference{}, largest{};
        const auto look = [&](size_t x, size_t lane) {
            const double va = static_cast<double>(bandA[x]), d = std::abs(va - static_cast<double>(bandB[x]));
            squares[lane] += d * d;
            difference[lane] = d > difference[lane] ? d : difference[lane];
            largest[lane] = std::abs(va) > largest[lane] ? std::abs(va) : largest[lane];
        };
        size_t x = 0;
        for (; x + lanes <= width_; x += lanes)
            for (size_t lane = 0; lane < lanes; ++lane)
                look(x + lane, lane);
        for (; x < width_; ++x)
            look(x, 0);
        for (size_t lane = 0; lane < lanes; ++lane) {
            rowSquares += squares[lane];
            largestDifference_[j] = std::max(largestDifference_[j], difference[lane]);
            largestA_[j] = std::max(largestA_[j], largest[lane]);
        }
    }
    // The squares of floats stay far inside double, so only a value that is no number can spoil the sum.
    if (!std::isfinite(rowSquares))
        throw InputError("a cube to compare holds a value that is no finite number");
    squares_ += rowSquares;
    values_ += bands_ * width_;

    for (size_t from = 0; from < width_; from += blockSize)
        addShapes(a, b, from, std::min(blockSize, width_ - from));
}

void BandDifferenceMeter::addShapes(const float* a, const float* b, size_t from, size_t count) {
    std::array<double, blockSize> aa{}, bb{}, ab{};
    for (size_t j = 0; j < bands_; ++j) {
        const float *bandA = a + j * width_ + from, *bandB = b + j * width_ + from;
        for (size_t x = 0; x < count; ++x) {
            const double va = static_cast<double>(bandA[x]), vb = static_cast<double>(bandB[x]);
            aa[x] += va * va;
            bb[x] += vb * vb;
            ab[x] += va * vb;
        }
    }
    // Near 1 the arc cosine loses half of the digits: the angle between unit vectors from their difference
    // and sum instead (Kahan, "How futile are mindless assessments of roundoff in floating-point
    // computation?", section 12).
    std::array<double, blockSize> unitA{}, unitB{}, difference{}, sum{};
    for (size_t x = 0; x < count; ++x) {
        unitA[x] = aa[x] > 0 ? 1 / std::sqrt(aa[x]) : 0;
        unitB[x] = bb[x] > 0 ? 1 / std::sqrt(bb[x]) : 0;
    }
    for (size_t j = 0; j < bands_; ++j) {
        const float *bandA = a + j * width_ + from, *bandB = b + j * width_ + from;
        for (size_t x = 0; x < count; ++x) {
            const double ua = static_cast<double>(bandA[x]) * unitA[x],
                         ub = static_cast<double>(bandB[x]) * unitB[x];
            difference[x] += (ua - ub) * (ua - ub);
            sum[x] += (ua + ub) * (ua + ub);
        }
    }
    for (size_t x = 0; x < count; ++x) {
        if (aa[x] == 0 || bb[x] == 0) {
            ++(aa[x] == bb[x] ? result_.blackInBoth : result_.blackInOne);
            continue;
        }
        ++result_.compared;
        result_.gfcMin = std::min(result_.gfcMin, std::clamp(ab[x] * unitA[x] * unitB[x], -1.0, 1.0));
        const double angle = 2 * std::atan2(std::sqrt(difference[x]), std::sqrt(sum[x]));
        result_.spectralAngleMax = std::max(result_.spectralAngleMax, angle);
    }
}

BandDifference BandDifferenceMeter::result() const {
    BandDifference result = result_;
    result.rmse = values_ > 0 ? std::sqrt(squares_ / static_cast<double>(values_)) : 0;
    for (size_t j = 0; j < bands_; ++j) {
        if (largestDifference_[j] == 0) continue;
        const double relative =
            largestA_[j] > 0 ? largestDifference_[j] / largestA_[j] : std::numeric_limits<double>::infinity();
        if (relative > result.relativeMax) {
            result.relativeMax = relative;
            result.relativeMaxBand = j;
        }
    }
    return result;
}

void BandDifferenceMeter::relativeErrors(const float* a, const float* b, std::vector<double>& out) const {
    const size_t first = out.size();
    out.resize(first + width_, 0.0);
    for (size_t j = 0; j < bands_; ++j)
        for (size_t x = 0; x < width_; ++x) {
            const double off = std::abs(double{a[j * width_ + x]} - double{b[j * width_ + x]});
            if (off > 0) out[first + x] = std::max(out[first + x], off / largestA_[j]);
        }
}

ColourDifference colourDifference(const ChannelImage& a, const ChannelImage& b, const Triple& white) {
    if (a.width != b.width || a.height != b.height)
        throw InputError("images of different size cannot be compared: " + std::to_string(a.width) + "x" +
                         std::to_string(a.height) + " and " + std::to_string(b.width) + "x" +
                         std::to_string(b.height));
    if (a.pixels() == 0) throw InputError("images without pixels cannot be compared");
    for (double w : white)
        if (!(w > 0) || !std::isfinite(w))
            throw InputError("colour differences need a white whose X, Y and Z are above 0, not " +
                             rounded(white[0], 4) + "," + rounded(white[1], 4) + "," + rounded(white[2], 4));
    ColourDifference result;
    std::vector<double> values(a.pixels());
    double sum = 0;
    for (size_t i = 0; i < values.size(); ++i) {
        const Triple labA = lab(a.triple(i), white), labB = lab(b.triple(i), white);
        values[i] = deltaE00(labA, labB);
        sum += values[i];
        const double older = deltaE76(labA, labB);
        result.mean76 += older;
        result.max76 = std::max(result.max76, older);
    }
    const auto largest = std::max_element(values.begin(), values.end());
    const auto at = static_cast<long long>(largest - values.begin());
    result.max = *largest;
    result.maxX = static_cast<int>(at % a.width);
    result.maxY = static_cast<int>(at / a.width);
    result.mean = sum / static_cast<double>(values.size());
    result.mean76 /= static_cast<double>(values.size());
    result.map.assign(values.begin(), values.end());
    result.p95 = quantile(values, 0.95);
    result.p99 = quantile(values, 0.99);
    return result;
}

std::vector<std::uint8_t> falseColours(const std::vector<float>& values, double top) {
    // Nine colours of "viridis" (van der Walt & Smith 2015, CC0), linear between.
    constexpr std::array<std::array<double, 3>, 9> scale{{{68, 1, 84},
                                                          {71, 44, 122},
                                                          {59, 81, 139},
                                                          {44, 113, 142},
                                                          {33, 144, 141},
                                                          {39, 173, 129},
                                                          {92, 200, 99},
                                                          {170, 220, 50},
                                                          {253, 231, 37}}};
    std::vector<std::uint8_t> pixels;
    pixels.reserve(3 * values.size());
    for (const float value : values) {
        const double share = top > 0 && value > 0 ? std::min(1.0, static_cast<double>(value) / top) : 0;
        const double place = share * (scale.size() - 1);
        const auto below = std::min(static_cast<size_t>(place), scale.size() - 2);
        for (size_t c = 0; c < 3; ++c) {
            const double level =
                std::lerp(scale[below][c], scale[below + 1][c], place - static_cast<double>(below));
            pixels.push_back(static_cast<std::uint8_t>(std::lround(level)));
        }
    }
    return pixels;
}

}  // namespace spectrad
