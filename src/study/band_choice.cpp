#include "study/band_choice.h"

#include "spectrum/mass_matrix.h"
#include "spectrum/projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace spectrad {

HatDetector::HatDetector(const Wavelengths& fine, const Detector& detector)
    : fine_(fine), moments_(fine.size()) {
    for (size_t c = 0; c < 3; ++c) {
        const std::vector<double> of = moments(fine, detector.response[c]);
        for (size_t n = 0; n < of.size(); ++n)
            moments_[n][c] = detector.scale * of[n];
    }
}

std::vector<std::array<double, 3>> HatDetector::weights(const std::vector<size_t>& nodes) const {
    const size_t count = nodes.size();
    std::vector<double> nm;
    for (size_t node : nodes)
        nm.push_back(fine_.nm[node]);
    // The outermost hats are one-sided: of the fine hats at their peaks, half.
    const auto inside = [&](size_t n) {
        return (n == nodes.front() && n > 0) || (n == nodes.back() && n + 1 < fine_.size()) ? 0.5 : 1.0;
    };
    std::vector<double> solved(3 * count, 0.0);  // [node][channel]
    const auto eachFine = [&](const auto& visit) {
        for (size_t j = 0; j + 1 < count; ++j)
            for (size_t n = nodes[j]; n < nodes[j + 1] || (j + 2 == count && n == nodes[j + 1]); ++n)
                visit(n, j, (fine_.nm[n] - nm[j]) / (nm[j + 1] - nm[j]));
    };
    eachFine([&](size_t n, size_t j, double t) {
        for (size_t c = 0; c < 3; ++c) {
            solved[3 * j + c] += (1 - t) * inside(n) * moments_[n][c];
            solved[3 * (j + 1) + c] += t * inside(n) * moments_[n][c];
        }
    });
    MassMatrix(nm).solveAll(solved, 3);
    std::vector<std::array<double, 3>> out(fine_.size());
    eachFine([&](size_t n, size_t j, double t) {
        for (size_t c = 0; c < 3; ++c)
            out[n][c] = inside(n) * std::lerp(solved[3 * j + c], solved[3 * (j + 1) + c], t);
    });
    return out;
}

namespace {

class Judge {
  public:
    Judge(const HatDetector& detector, const Palette& palette, const Triple& white, bool all)
        : detector_(detector), palette_(palette), white_(white), all_(all) {
        for (const Triple& xyz : palette.xyz)
            right_.push_back(lab(xyz, white));
    }

    /// The ΔE00 that 99 % (or all) of the palette's pixels are within; `mean` to tell equals apart.
    double error(const std::vector<size_t>& nodes, double& mean) const {
        const auto weights = detector_.weights(nodes);
        std::vector<std::pair<double, double>> found;  // ΔE00, share
        mean = 0;
        for (size_t i = 0; i < right_.size(); ++i) {
            Triple xyz{};
            const std::vector<double>& spectrum = palette_.moments[i];
            for (size_t n = nodes.front(); n <= nodes.back(); ++n)
                for (size_t c = 0; c < 3; ++c)
                    xyz[c] += weights[n][c] * spectrum[n];
            found.emplace_back(deltaE00(right_[i], lab(xyz, white_)), palette_.share[i]);
            mean += found.back().first * palette_.share[i];
        }
        std::sort(found.begin(), found.end(), std::greater<>());
        if (all_) return found.front().first;
        double beyond = 0;
        for (const auto& [difference, share] : found)
            if ((beyond += share) > 0.01) return difference;
        return found.back().first;
    }

  private:
    const HatDetector& detector_;
    const Palette& palette_;
    Triple white_;
    bool all_;
    std::vector<Triple> right_;
};

std::vector<size_t> regular(const Wavelengths& fine, double from, double to, double step) {
    std::vector<size_t> nodes;
    for (size_t n = 0; n < fine.size(); ++n)
        if (fine.nm[n] >= from && fine.nm[n] <= to && std::fmod(fine.nm[n] - from + 1e-9, step) < 1e-6)
            nodes.push_back(n);
    return nodes;
}

}  // namespace

std::vector<BandSet> bandSets(const Wavelengths& fine, const HatDetector& detector, const Palette& palette,
                              const Triple& white, bool all) {
    const Judge judge(detector, palette, white, all);
    std::map<size_t, BandSet> best;
    double mean = 0;
    const auto offer = [&](const std::vector<size_t>& nodes, const std::string& how) {
        if (nodes.size() < 2) return;
        const double error = judge.error(nodes, mean);
        const auto found = best.find(nodes.size());
        if (found == best.end() || error < found->second.error) best[nodes.size()] = {nodes, how, error};
    };
    for (const auto& [from, to] : {std::pair{380.0, 780.0}, {380.0, 730.0}, {400.0, 720.0}, {400.0, 700.0}})
        for (double step : {10.0, 15.0, 20.0, 25.0, 30.0, 40.0})
            offer(regular(fine, from, to, step),
                  fmt::format("every {} nm from {}", static_cast<int>(step), static_cast<int>(from)));
    std::vector<size_t> nodes = regular(fine, 380, 780, 5);
    offer(nodes, "every 5 nm from 380");
    while (nodes.size() > 3) {
        size_t least = 0;
        double score = 0;
        for (size_t k = 0; k < nodes.size(); ++k) {
            std::vector<size_t> fewer = nodes;
            fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
            const double error = judge.error(fewer, mean);
            // The mean keeps what few pixels need from being given up while the quantile does not move.
            const double sum = error + mean;
            if (k == 0 || sum < score) least = k, score = sum;
        }
        nodes.erase(nodes.begin() + static_cast<std::ptrdiff_t>(least));
        offer(nodes, "where this scene's lights and surfaces need them");
    }
    offer(regular(fine, fine.nm.front(), fine.nm.back(), 2), "every 2 nm");
    offer(regular(fine, fine.nm.front(), fine.nm.back(), 1), "every nm");
    std::vector<BandSet> sets;
    for (auto& [count, set] : best)
        sets.push_back(std::move(set));
    return sets;
}

}  // namespace spectrad
