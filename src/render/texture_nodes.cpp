#include "render/texture_nodes.h"

#include "render/resident.h"
#include "render/texels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace spectrad {

namespace {

/// Within an interval between a texture's wavelengths `steps` + 1 even nodes are joined by polynomials of
/// this degree (a multiple of it is that many pieces): higher ones through even nodes would swing.
constexpr int highestDegree = 4;

/// Whether the polynomial through `degree` + 1 even nodes on low…high is within `tolerance` of rho^p (1 − r)
/// / (1 − rho r), as a share of its value at the high end. With z = 1 / r it is a multiple of 1 / (z − rho),
/// whose error is Π (rho − node) / Π (z − node) / (z − rho). Multiplied out, so that kernels/steps.cl comes
/// to the same answer to the bit.
bool nearEnough(double low, double high, double z, int p, int degree, double tolerance) {
    const double spacing = (high - low) / degree;
    double error = p == 2   ? z * z
                   : p == 1 ? z
                            : 1.0,
           bound = tolerance * (p == 2   ? high * high
                                : p == 1 ? high
                                         : 1.0);
    // |Π (rho − node)| is largest in the outermost interval: below degree! spacing^(degree + 1) / 4.
    for (int k = 0; k <= degree; ++k) {
        error *= spacing * (k == 0 ? 0.25 : k);
        bound *= z - low - spacing * k;
    }
    return error <= bound;
}

/// The first and the last node of the pieces that a node belongs to.
std::pair<size_t, size_t> reach(const std::vector<double>& nm, int steps, size_t node) {
    const auto degree = static_cast<size_t>(std::min(steps, highestDegree));
    return {node == 0 ? 0 : (node - 1) / degree * degree,
            std::min(nodeCount(nm, steps) - 1, node / degree * degree + degree)};
}

}  // namespace

double nodePlace(const std::vector<double>& nm, int steps, size_t node) {
    const auto per = static_cast<size_t>(steps);
    const size_t interval = std::min(node / per, nm.size() - 2);
    return nm[interval] + (nm[interval + 1] - nm[interval]) * static_cast<double>(node - interval * per) /
                              static_cast<double>(per);
}

std::pair<double, double> nodeSupport(const std::vector<double>& nm, int steps, size_t node) {
    constexpr double endless = std::numeric_limits<double>::infinity();
    if (nm.size() == 1) return {-endless, endless};
    const auto [from, to] = reach(nm, steps, node);
    return {node == 0 ? -endless : nodePlace(nm, steps, from),
            node + 1 == nodeCount(nm, steps) ? endless : nodePlace(nm, steps, to)};
}

Curve nodeCurve(const std::vector<double>& nm, int steps, size_t node) {
    if (nm.size() == 1) return Curve::constant(1);
    const auto degree = static_cast<size_t>(std::min(steps, highestDegree));
    const size_t last = nodeCount(nm, steps) - 1;
    const auto place = [&](size_t n) { return nodePlace(nm, steps, n); };
    const auto [from, to] = reach(nm, steps, node);
    if (steps == 1) {
        std::vector<double> at, value;
        for (size_t n = from; n <= to; ++n) {
            at.push_back(nm[n]);
            value.push_back(n == node ? 1.0 : 0.0);
        }
        return Curve::table(at, value, Outside::hold);
    }
    // The pieces to the left and to the right of the node, or the one around it.
    struct Piece {
        double from, to;
        std::vector<double> others;
    };
    std::vector<Piece> pieces;
    for (size_t first = from; first < to; first += degree) {
        Piece piece{place(first), place(first + degree), {}};
        for (size_t n = first; n <= first + degree; ++n)
            if (n != node) piece.others.push_back(place(n));
        pieces.push_back(std::move(piece));
    }
    const double own = place(node), begin = place(from), end = place(to);
    const bool isFirst = node == 0, isLast = node == last;
    const auto value = [=](double wavelength) {
        if (wavelength <= begin) return isFirst ? 1.0 : 0.0;
        if (wavelength >= end) return isLast ? 1.0 : 0.0;
        const Piece& piece = wavelength < pieces.front().to ? pieces.front() : pieces.back();
        double product = 1;
        for (double other : piece.others)
            product *= (wavelength - other) / (own - other);
        return product;
    };
    const auto breaks = [=](double low, double high, std::vector<double>& out) {
        for (double edge : {begin, pieces.front().to, end})
            if (edge > low && edge < high && (out.empty() || out.back() != edge)) out.push_back(edge);
    };
    return Curve::formula(value, breaks,
                          isFirst || isLast ? std::nullopt : std::optional(std::pair(begin, end)));
}

int stepsFor(const World& world, std::uint32_t number, double inside, int power, double tolerance) {
    constexpr int most = 16 * highestDegree;
    if (inside <= 0) return 1;
    if (const ResidentTexels* resident = residentOf(world, number))
        return stepsOn(*resident, inside, power, tolerance, most);
    const sd_texture& t = world.textures[number - 1];
    int steps = 1;
    const auto enough = [&](double low, double high) {
        const int degree = std::min(steps, highestDegree);
        // The error is largest in the last piece.
        return nearEnough(high - (high - low) * degree / steps, high, 1 / inside, power, degree, tolerance);
    };
    const auto bands = static_cast<size_t>(t.bands);
    const size_t texels = static_cast<size_t>(t.width) * static_cast<size_t>(t.height);
    for (size_t i = 0; i < texels; ++i) {
        const float* texel = world.texels.data() + t.first + i * bands;
        if (i > 0 && std::equal(texel, texel + bands, texel - bands)) continue;  // pictures repeat colours
        for (size_t b = 0; b + 1 < bands; ++b) {
            const double low = std::min(texel[b], texel[b + 1]),
                         high = std::min<double>(std::max(texel[b], texel[b + 1]), 1);
            while (steps < most && !enough(std::min(low, high), high))
                steps += steps < highestDegree ? 1 : highestDegree;
        }
    }
    return steps;
}

}  // namespace spectrad
