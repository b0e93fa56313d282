#include "colour/observe.h"

#include "base/cholesky.h"
#include "base/text.h"
#include "spectrum/projection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spectrad {

void observeRow(const DetectorWeights& detector, const float* bands, int y, ChannelImage& image) {
    // Blocks of pixels whose sums stay in the first-level cache while the bands go by.
    constexpr size_t blockSize = 256;
    std::array<double, blockSize> sum;
    const auto width = static_cast<size_t>(image.width);
    const size_t row = static_cast<size_t>(y) * width;
    for (size_t from = 0; from < width; from += blockSize) {
        const size_t count = std::min(blockSize, width - from);
        for (size_t c = 0; c < detector.weights.size(); ++c) {
            sum.fill(0);
            for (size_t j = 0; j < detector.weights[c].size(); ++j) {
                const double weight = detector.weights[c][j];
                const float* band = bands + j * width + from;
                for (size_t x = 0; x < count; ++x)
                    sum[x] += weight * static_cast<double>(band[x]);
            }
            for (size_t x = 0; x < count; ++x) {
                if (!std::isfinite(sum[x]))
                    throw InputError("pixel (" + std::to_string(from + x) + ", " + std::to_string(y) +
                                     ") holds a value that is no finite number");
                image.plane[c][row + from + x] = sum[x];
            }
        }
    }
}

std::vector<std::vector<float>> floatPlanes(const ChannelImage& image,
                                            const std::vector<std::string>& channels) {
    std::vector<std::vector<float>> result;
    for (size_t c = 0; c < image.plane.size(); ++c) {
        std::vector<float>& plane = result.emplace_back(image.plane[c].size());
        for (size_t i = 0; i < plane.size(); ++i) {
            const double value = image.plane[c][i];
            if (!(std::abs(value) <= std::numeric_limits<float>::max()))
                throw InputError("channel " + channels[c] + " of pixel (" +
                                 std::to_string(i % static_cast<size_t>(image.width)) + ", " +
                                 std::to_string(i / static_cast<size_t>(image.width)) + ") is " +
                                 rounded(value, 4) + ", beyond the range of float (allowed: up to 3.4e38)");
            plane[i] = static_cast<float>(value);
        }
    }
    return result;
}

XyzMatrix towardsXyz(const Detector& detector, const Detector& observer) {
    if (!observer.tristimulus)
        throw InputError("XYZ need an observer with the channels X, Y, Z, not '" + observer.name + "'");
    const size_t n = detector.size();
    if (detector.tristimulus) return {std::vector<double>{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

    if (detector.channels == std::vector<std::string>{"V"})
        return {std::vector<double>{1}, std::vector<double>{1}, std::vector<double>{1}};

    const auto overlap = [](const Curve& a, const Curve& b) {
        const std::array<const Curve*, 2> both{&a, &b};
        return integrate(both);
    };
    std::vector<std::vector<double>> gram(n, std::vector<double>(n));
    double trace = 0;
    for (size_t i = 0; i < n; ++i) {
        for (size_t j = 0; j <= i; ++j)
            gram[i][j] = gram[j][i] = overlap(detector.response[i], detector.response[j]);
        trace += gram[i][i];
    }
    if (!(trace > 0)) throw InputError("'" + detector.name + "' has no sensitivity at any wavelength");
    const Cholesky factor(std::move(gram));
    XyzMatrix matrix;
    for (size_t k = 0; k < 3; ++k) {
        std::vector<double> target(n);
        for (size_t i = 0; i < n; ++i)
            target[i] = overlap(detector.response[i], observer.response[k]);
        matrix[k] = factor.solve(std::move(target));
        for (double& m : matrix[k])
            m *= observer.scale / detector.scale;
    }
    return matrix;
}

Eye standardEye(const Library& library) {
    Detector observer = standardObserver(library);
    XyzMatrix itself = towardsXyz(observer, observer);
    return {std::move(observer), std::move(itself)};
}

Triple seenXyz(const Eye& eye, std::span<const Curve* const> product) {
    return toXyz(eye.matrix, respond(eye.detector, product));
}

Triple toXyz(const XyzMatrix& matrix, const std::vector<double>& channels) {
    Triple xyz{};
    for (size_t k = 0; k < 3; ++k)
        for (size_t c = 0; c < channels.size(); ++c)
            xyz[k] += matrix[k][c] * channels[c];
    return xyz;
}

ChannelImage toXyz(const XyzMatrix& matrix, const ChannelImage& channels) {
    ChannelImage xyz(channels.width, channels.height, 3);
    for (size_t k = 0; k < 3; ++k)
        for (size_t c = 0; c < channels.plane.size(); ++c)
            for (size_t i = 0; i < channels.pixels(); ++i)
                xyz.plane[k][i] += matrix[k][c] * channels.plane[c][i];
    return xyz;
}

}  // namespace spectrad
