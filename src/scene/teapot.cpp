// The teapot has 32 patches with 306 control points. Its symmetry leaves ten of them: rim, body, lid and
// bottom repeat in four quarters, handle and spout in two halves. Points are Newell's, z up; the mesh turns
// them to y up. Lid and body do not join, spout and handle run into the body: it is a surface to look at, not
// a solid.
#include "scene/teapot.h"

#include "scene/mesh_builder.h"

#include <algorithm>
#include <array>

namespace spectrad {

namespace {

// clang-format off
constexpr Vec3 points[127] = {
    // lid, where knob and cover meet
    {0.2, 0, 2.7}, {0.2, -0.112, 2.7}, {0.112, -0.2, 2.7}, {0, -0.2, 2.7},
    // rim
    {1.3375, 0, 2.53125}, {1.3375, -0.749, 2.53125}, {0.749, -1.3375, 2.53125}, {0, -1.3375, 2.53125},
    {1.4375, 0, 2.53125}, {1.4375, -0.805, 2.53125}, {0.805, -1.4375, 2.53125}, {0, -1.4375, 2.53125},
    // body
    {1.5, 0, 2.4}, {1.5, -0.84, 2.4}, {0.84, -1.5, 2.4}, {0, -1.5, 2.4},
    {1.75, 0, 1.875}, {1.75, -0.98, 1.875}, {0.98, -1.75, 1.875}, {0, -1.75, 1.875},
    {2, 0, 1.35}, {2, -1.12, 1.35}, {1.12, -2, 1.35}, {0, -2, 1.35},
    {2, 0, 0.9}, {2, -1.12, 0.9}, {1.12, -2, 0.9}, {0, -2, 0.9},
    {-2, 0, 0.9}, {2, 0, 0.45}, {2, -1.12, 0.45}, {1.12, -2, 0.45},
    {0, -2, 0.45}, {1.5, 0, 0.225}, {1.5, -0.84, 0.225}, {0.84, -1.5, 0.225},
    {0, -1.5, 0.225}, {1.5, 0, 0.15}, {1.5, -0.84, 0.15}, {0.84, -1.5, 0.15},
    {0, -1.5, 0.15},
    // handle
    {-1.6, 0, 2.025}, {-1.6, -0.3, 2.025}, {-1.5, -0.3, 2.25}, {-1.5, 0, 2.25},
    {-2.3, 0, 2.025}, {-2.3, -0.3, 2.025}, {-2.5, -0.3, 2.25}, {-2.5, 0, 2.25},
    {-2.7, 0, 2.025}, {-2.7, -0.3, 2.025}, {-3, -0.3, 2.25}, {-3, 0, 2.25},
    {-2.7, 0, 1.8}, {-2.7, -0.3, 1.8}, {-3, -0.3, 1.8}, {-3, 0, 1.8},
    {-2.7, 0, 1.575}, {-2.7, -0.3, 1.575}, {-3, -0.3, 1.35}, {-3, 0, 1.35},
    {-2.5, 0, 1.125}, {-2.5, -0.3, 1.125}, {-2.65, -0.3, 0.9375}, {-2.65, 0, 0.9375},
    {-2, -0.3, 0.9}, {-1.9, -0.3, 0.6}, {-1.9, 0, 0.6},
    // spout
    {1.7, 0, 1.425}, {1.7, -0.66, 1.425}, {1.7, -0.66, 0.6}, {1.7, 0, 0.6},
    {2.6, 0, 1.425}, {2.6, -0.66, 1.425}, {3.1, -0.66, 0.825}, {3.1, 0, 0.825},
    {2.3, 0, 2.1}, {2.3, -0.25, 2.1}, {2.4, -0.25, 2.025}, {2.4, 0, 2.025},
    {2.7, 0, 2.4}, {2.7, -0.25, 2.4}, {3.3, -0.25, 2.4}, {3.3, 0, 2.4},
    {2.8, 0, 2.475}, {2.8, -0.25, 2.475}, {3.525, -0.25, 2.49375}, {3.525, 0, 2.49375},
    {2.9, 0, 2.475}, {2.9, -0.15, 2.475}, {3.45, -0.15, 2.5125}, {3.45, 0, 2.5125},
    {2.8, 0, 2.4}, {2.8, -0.15, 2.4}, {3.2, -0.15, 2.4}, {3.2, 0, 2.4},
    // knob
    {0, 0, 3.15}, {0.8, 0, 3.15}, {0.8, -0.45, 3.15}, {0.45, -0.8, 3.15},
    {0, -0.8, 3.15}, {0, 0, 2.85},
    // inner edge of the rim
    {1.4, 0, 2.4}, {1.4, -0.784, 2.4}, {0.784, -1.4, 2.4}, {0, -1.4, 2.4},
    // cover
    {0.4, 0, 2.55}, {0.4, -0.224, 2.55}, {0.224, -0.4, 2.55}, {0, -0.4, 2.55},
    {1.3, 0, 2.55}, {1.3, -0.728, 2.55}, {0.728, -1.3, 2.55}, {0, -1.3, 2.55},
    {1.3, 0, 2.4}, {1.3, -0.728, 2.4}, {0.728, -1.3, 2.4}, {0, -1.3, 2.4},
    // bottom
    {0, 0, 0}, {1.425, -0.798, 0}, {1.5, 0, 0.075}, {1.425, 0, 0},
    {0.798, -1.425, 0}, {0, -1.5, 0.075}, {0, -1.425, 0}, {1.5, -0.84, 0.075},
    {0.84, -1.5, 0.075},
};
// clang-format on

using PatchIndices = std::array<std::uint8_t, 16>;
/// Four rows of four; along a row around the axis (or the tube), from row to row along the profile.
constexpr PatchIndices quarters[] = {
    {102, 103, 104, 105, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15},                // rim
    {12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27},              // upper body
    {24, 25, 26, 27, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40},              // lower body
    {96, 96, 96, 96, 97, 98, 99, 100, 101, 101, 101, 101, 0, 1, 2, 3},             // knob
    {0, 1, 2, 3, 106, 107, 108, 109, 110, 111, 112, 113, 114, 115, 116, 117},      // cover
    {118, 118, 118, 118, 124, 122, 119, 121, 123, 126, 125, 120, 40, 39, 38, 37},  // bottom
};
constexpr PatchIndices halves[] = {
    {41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56},  // upper handle
    {53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 28, 65, 66, 67},  // lower handle
    {68, 69, 70, 71, 72, 73, 74, 75, 76, 77, 78, 79, 80, 81, 82, 83},  // spout
    {80, 81, 82, 83, 84, 85, 86, 87, 88, 89, 90, 91, 92, 93, 94, 95},  // its mouth
};

using Patch = std::array<Vec3, 16>;

/// A patch mirrored as asked, in y-up space. One mirror turns a surface inside out; reversing the rows turns
/// it back.
Patch placed(const PatchIndices& indices, bool mirrorX, bool mirrorY, double scale) {
    Patch patch;
    for (size_t row = 0; row < 4; ++row) {
        for (size_t column = 0; column < 4; ++column) {
            const Vec3 p = points[indices[row * 4 + (mirrorX != mirrorY ? 3 - column : column)]];
            patch[row * 4 + column] = Vec3{mirrorX ? -p.x : p.x, p.z, mirrorY ? p.y : -p.y} * scale;
        }
    }
    return patch;
}

std::vector<Patch> allPatches(double scale) {
    std::vector<Patch> patches;
    for (const PatchIndices& indices : quarters)
        for (const bool mirrorX : {false, true})
            for (const bool mirrorY : {false, true})
                patches.push_back(placed(indices, mirrorX, mirrorY, scale));
    for (const PatchIndices& indices : halves)
        for (const bool mirrorY : {false, true})
            patches.push_back(placed(indices, false, mirrorY, scale));
    return patches;
}

/// Bernstein polynomials of degree 3 and their derivatives at t = i / n. Symmetric to the last bit under i →
/// n − i, so that patches that meet share their edge exactly whichever way each runs along it.
struct Basis {
    std::array<double, 4> value, slope;
    Basis(int i, int n) {
        const double t = static_cast<double>(i) / n, s = static_cast<double>(n - i) / n;
        value = {s * s * s, 3 * (s * s) * t, 3 * (t * t) * s, t * t * t};
        slope = {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
    }
};

Vec3 blend(const std::array<double, 4>& w, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    return (a * w[0] + d * w[3]) + (b * w[1] + c * w[2]);
}

Vec3 blend(const Patch& p, const std::array<double, 4>& across, const std::array<double, 4>& along) {
    return blend(along, blend(across, p[0], p[1], p[2], p[3]), blend(across, p[4], p[5], p[6], p[7]),
                 blend(across, p[8], p[9], p[10], p[11]), blend(across, p[12], p[13], p[14], p[15]));
}

/// The true surface's normal. At the knob's top and the bottom's middle a whole row is one point and ∂P/∂u
/// vanishes; it does so like v · ∂²P/∂u∂v, which therefore has the limit of its direction.
Vec3 normalAt(const Patch& p, const Basis& u, const Basis& v) {
    const Vec3 pv = blend(p, u.value, v.slope);
    Vec3 pu = blend(p, u.slope, v.value);
    if (length(pu) < 1e-9 * length(pv)) pu = blend(p, u.slope, v.slope);
    return normalized(cross(pu, pv));
}

/// Pieces a side for a distance of at most `tolerance` between patch and triangles: the error of linear
/// interpolation over a cell is at most (max|P_uu| + 2 max|P_uv| + max|P_vv|) / (8 n²) (Filip, Magedson &
/// Markot 1986), and derivatives of a Bézier patch are bounded by differences of its control points.
double piecesNeeded(const Patch& p, double tolerance) {
    double uu = 0, uv = 0, vv = 0;
    for (size_t row = 0; row < 4; ++row) {
        for (size_t column = 0; column < 4; ++column) {
            const size_t at = row * 4 + column;
            if (column < 2) uu = std::max(uu, 6 * length(p[at] - p[at + 1] * 2 + p[at + 2]));
            if (row < 2) vv = std::max(vv, 6 * length(p[at] - p[at + 4] * 2 + p[at + 8]));
            if (row < 3 && column < 3)
                uv = std::max(uv, 9 * length(p[at] - p[at + 1] - p[at + 4] + p[at + 5]));
        }
    }
    return std::sqrt((uu + 2 * uv + vv) / (8 * tolerance));
}

}  // namespace

Mesh tessellateTeapot(double height, double tolerance, int maxSegments) {
    const std::vector<Patch> patches = allPatches(height / teapotHeight);
    // One number for all patches: neighbours then share the vertices of their common edge.
    double needed = 3;
    for (const Patch& patch : patches)
        needed = std::max(needed, piecesNeeded(patch, tolerance));
    const int n = static_cast<int>(std::min(std::ceil(needed), std::max(3.0, maxSegments / 4.0)));

    MeshBuilder mesh;
    for (const Patch& patch : patches) {
        std::uint32_t first = 0;
        for (int j = 0; j <= n; ++j) {
            const Basis v(j, n);
            for (int i = 0; i <= n; ++i) {
                const Basis u(i, n);
                const std::uint32_t index =
                    mesh.vertex(blend(patch, u.value, v.value), normalAt(patch, u, v),
                                static_cast<double>(i) / n, static_cast<double>(n - j) / n);
                if (i == 0 && j == 0) first = index;
            }
        }
        const auto at = [&](int i, int j) { return first + static_cast<std::uint32_t>(j * (n + 1) + i); };
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                mesh.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
    return mesh.finish("teapot");
}

double teapotBoundingRadius(double height) {
    double radius = 0;
    for (const Vec3& p : points)
        radius = std::max(radius, length(p));  // a patch lies in the hull of its points
    return radius * height / teapotHeight;
}

}  // namespace spectrad
