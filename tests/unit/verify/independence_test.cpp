// What the reference takes from the renderer – triangles, tables of angles, terms, texels and where they are
// looked up – held against a picture made without any of it: rays that meet the shapes' own equations,
// Fresnel's formulae with complex numbers at every quarter of a nanometre, texels mixed by hand.
#include "unit/verify/judged_scene.h"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

using namespace spectrad;
using test::JudgedScene;

namespace {

constexpr const char* text = R"(<scene version="1">
  <wavelengths from="400" to="700" step="25"/>
  <material name="mirror"><conductor ior="metals/Cu"/></material>
  <material name="car"><diffuse reflectance="charts/colorchecker/red"/><gloss ior="1.5"/></material>
  <material name="wall"><diffuse texture="texels.exr" wrap="repeat" scale="2 3" rotate="20" offset="0.1 0.3"/></material>
  <node translate="-1 0 0"><sphere radius="0.9" material="mirror"/></node>
  <node translate="1 0 0"><sphere radius="0.9" material="car"/></node>
  <node translate="0 0 -1"><plane size="6 4" material="wall"/></node>
  <light name="sun" type="directional" direction="-1 -1 -2" spectrum="illuminants/D65" illuminance="300 lx"/>
  <light name="sky" type="ambient" spectrum="blackbody:2700" luminance="80 cd/m2"/>
  <camera name="c" fov="36" look-from="0 0 6" look-at="0 0 0" size="96x64"/>
</scene>)";
constexpr int width = 96, height = 64;

constexpr int texelsWide = 5, texelsHigh = 4;
const std::vector<double> texelNm{400, 475, 550, 625, 700};
/// Values that halves and floats hold exactly.
float texelAt(int x, int y, size_t band) {
    return static_cast<float>((x * 7 + y * 11 + static_cast<int>(band) * 5) % 16 + 1) / 16;
}
void writeTexels(const std::filesystem::path& file) {
    CubeInfo info;
    info.width = texelsWide;
    info.height = texelsHigh;
    info.kind = CubeKind::reflectance;
    info.wavelengths = {texelNm, Projection::point};
    info.projectionStated = true;
    std::vector<float> values, preview(3 * texelsWide * texelsHigh, 0.5f);
    for (int y = 0; y < texelsHigh; ++y)
        for (size_t band = 0; band < texelNm.size(); ++band)
            for (int x = 0; x < texelsWide; ++x)
                values.push_back(texelAt(x, y, band));
    const auto writer = createExr(file, info, {});
    writer->write(texelsHigh, values.data(), preview.data());
    static_cast<void>(writer->finish());
}

using Spectral = std::vector<double>;
constexpr double stepNm = 0.25;
/// Midpoints of the steps from 400 to 700 nm.
double nmAt(size_t i) {
    return 400 + stepNm * (static_cast<double>(i) + 0.5);
}
constexpr auto steps = static_cast<size_t>(300 / stepNm);
Spectral sampled(const Curve& curve) {
    Spectral values(steps);
    for (size_t i = 0; i < steps; ++i)
        values[i] = curve.at(nmAt(i));
    return values;
}

using Point = std::array<double, 3>;
double dotOf(const Point& a, const Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point along(const Point& from, const Point& direction, double t) {
    return {from[0] + t * direction[0], from[1] + t * direction[1], from[2] + t * direction[2]};
}

/// Unpolarized reflectance of a plane surface with the index n + ik.
double fresnel(double cosine, std::complex<double> index) {
    const std::complex<double> inside = std::sqrt(1.0 - (1 - cosine * cosine) / (index * index));
    const std::complex<double> s = (cosine - index * inside) / (cosine + index * inside),
                               p = (index * cosine - inside) / (index * cosine + inside);
    return (std::norm(s) + std::norm(p)) / 2;
}

class Oracle {
  public:
    explicit Oracle(const JudgedScene& s) {
        sun_ = sampled(s.scene.lights[0].emitter.spectrum.curve());
        sky_ = sampled(s.scene.lights[1].emitter.spectrum.curve());
        const Curve &eye = s.observer.response[1], &sun = s.scene.lights[0].emitter.spectrum.curve(),
                    &sky = s.scene.lights[1].emitter.spectrum.curve();
        double ofSun = 0, ofSky = 0;
        for (double nm = 360 + stepNm / 2; nm < 830; nm += stepNm) {
            ofSun += stepNm * eye.at(nm) * sun.at(nm);
            ofSky += stepNm * eye.at(nm) * sky.at(nm);
        }
        for (double& value : sun_)
            value *= 300 / (683.002 * ofSun);
        for (double& value : sky_)
            value *= 80 / (683.002 * ofSky);
        for (const Material& material : s.scene.materials) {
            if (material.name == "car") red_ = sampled(material.diffuse->reflectance->curve());
            if (material.name != "mirror") continue;
            n_ = sampled(material.conductor->ior.curves.at(0));
            k_ = sampled(material.conductor->ior.curves.at(1));
        }
        constexpr int angles = 20000;
        for (int i = 0; i < angles; ++i) {
            const double c = (i + 0.5) / angles;
            meanCoat_ += 2 * c * fresnel(c, 1.5) / angles;
        }
    }

    /// Adds the radiance of the sample that is seen there; says what shape that is, and holds `grazing` at or
    /// below the cosine that it is seen at.
    int shape(double x, double y, Spectral& radiance, double& grazing) const {
        // Vertical field of view of 36 degrees; x, y in pixels from the image's centre, y down.
        const double slope = std::tan(18 * std::numbers::pi / 180) / (height / 2.0);
        Point ray{x * slope, -y * slope, -1};
        const double length = std::sqrt(dotOf(ray, ray));
        for (double& component : ray)
            component /= length;
        const Point eye{0, 0, 6};
        for (int ball : {0, 1}) {
            const Point centre{ball == 0 ? -1.0 : 1.0, 0, 0};
            const Point to = along(eye, centre, -1);
            const double b = dotOf(to, ray), c = dotOf(to, to) - 0.81, root = b * b - c;
            if (root < 0) continue;
            Point normal = along(along(eye, ray, -b - std::sqrt(root)), centre, -1);
            for (double& component : normal)
                component /= 0.9;
            const double seen = -dotOf(normal, ray);
            grazing = std::min(grazing, seen);
            ball == 0 ? addMirror(seen, radiance) : addCar(seen, sunOn(normal), radiance);
            return ball;
        }
        const Point place = along(eye, ray, -7 / ray[2]);
        if (std::abs(place[0]) > 3 || std::abs(place[1]) > 2) return 3;
        addWall(place, radiance);
        return 2;
    }

    /// Means under hats every 25 nm, one-sided at both ends.
    static std::vector<double> bands(const Spectral& radiance) {
        std::vector<double> sum(13, 0.0), area(13, 0.0);
        for (size_t i = 0; i < steps; ++i)
            for (size_t b = 0; b < sum.size(); ++b) {
                const double hat = 1 - std::abs(nmAt(i) - (400 + 25 * static_cast<double>(b))) / 25;
                if (hat <= 0) continue;
                sum[b] += hat * radiance[i];
                area[b] += hat;
            }
        for (size_t b = 0; b < sum.size(); ++b)
            sum[b] /= area[b];
        return sum;
    }

  private:
    /// Cosine of the sun's incidence.
    static double sunOn(const Point& normal) {
        return std::max(0.0, (normal[0] + normal[1] + 2 * normal[2]) / std::sqrt(6.0));
    }
    void addMirror(double seen, Spectral& radiance) const {
        for (size_t i = 0; i < steps; ++i)
            radiance[i] += fresnel(seen, {n_[i], k_[i]}) * sky_[i];
    }
    /// The coat mirrors the sky; what it lets through to a diffuse base, and out again, is spread like
    /// (1 − F(in)) (1 − F(out)) / (1 − F̄), and inside it goes back and forth: ρ (1 − r) / (1 − ρ r).
    void addCar(double seen, double lit, Spectral& radiance) const {
        const double coat = fresnel(seen, 1.5), inside = 1 - (1 - meanCoat_) / (1.5 * 1.5);
        const double bySun =
            lit > 0 ? (1 - fresnel(lit, 1.5)) * (1 - coat) / (1 - meanCoat_) * lit / std::numbers::pi : 0;
        for (size_t i = 0; i < steps; ++i) {
            const double base = red_[i] * (1 - inside) / (1 - red_[i] * inside);
            radiance[i] += (coat + (1 - coat) * base) * sky_[i] + bySun * base * sun_[i];
        }
    }
    void addWall(const Point& place, Spectral& radiance) const {
        const double lit = sunOn({0, 0, 1});
        const double u = 2 * (place[0] / 6 + 0.5), v = 3 * (place[1] / 4 + 0.5),
                     angle = 20 * std::numbers::pi / 180;
        const double s = std::cos(angle) * u - std::sin(angle) * v + 0.1,
                     t = std::sin(angle) * u + std::cos(angle) * v + 0.3;
        const double column = s * texelsWide - 0.5, row = -t * texelsHigh - 0.5;  // rows from the top
        const double x = column - std::floor(column), y = row - std::floor(row);
        const auto wrapped = [](double at, int count) {
            const int whole = static_cast<int>(std::floor(at)) % count;
            return whole < 0 ? whole + count : whole;
        };
        const int left = wrapped(column, texelsWide), top = wrapped(row, texelsHigh),
                  right = (left + 1) % texelsWide, below = (top + 1) % texelsHigh;
        std::array<double, 5> mixed{};
        for (size_t band = 0; band < mixed.size(); ++band)
            mixed[band] = (1 - y) * ((1 - x) * texelAt(left, top, band) + x * texelAt(right, top, band)) +
                          y * ((1 - x) * texelAt(left, below, band) + x * texelAt(right, below, band));
        for (size_t i = 0; i < steps; ++i) {
            const double at = (nmAt(i) - 400) / 75;
            const size_t from = std::min<size_t>(static_cast<size_t>(at), 3);
            const double rho = std::lerp(mixed[from], mixed[from + 1], at - static_cast<double>(from));
            radiance[i] += rho * (sky_[i] + lit * sun_[i] / std::numbers::pi);
        }
    }

    Spectral sun_, sky_, red_, n_, k_;
    double meanCoat_ = 0;
};

}  // namespace

TEST_CASE("the reference is what shapes, texels and Fresnel's formulae give without triangles and terms") {
    JudgedScene s(text, [](const TemporaryFolder& beside) { writeTexels(beside.path() / "texels.exr"); });
    const Oracle oracle(s);
    const Reference reference(s.scene, {}, s.scene.wavelengths, s.observer, s.library, s.device);
    const SamplePattern pattern = samplePattern(referenceSamples);
    std::vector<PixelPlace> places;
    for (int y = 0; y < height; ++y)
        for (int x = y % 5; x < width; x += 5)
            places.push_back({x, y});
    const std::vector<ReferencePixel> found = reference.at(places);
    // Largest error of a band ÷ the pixel's largest band: [shape], of pixels within it that are seen at up to
    // 60 degrees, at more, and of pixels that show another shape as well.
    std::array<double, 3> inside{}, rim{}, outline{};
    std::array<int, 3> judged{};
    for (size_t p = 0; p < places.size(); ++p) {
        Spectral radiance(steps, 0.0);
        int seen = -1;
        bool edge = false;
        double grazing = 1;
        for (size_t k = 0; k < pattern.x.size(); ++k) {
            const double x = places[p].x - width / 2.0 + pattern.x[k] / double{SD_SUBPIXEL},
                         y = places[p].y - height / 2.0 + pattern.y[k] / double{SD_SUBPIXEL};
            const int shape = oracle.shape(x, y, radiance, grazing);
            edge = edge || (seen >= 0 && shape != seen);
            seen = shape;
        }
        const std::vector<double> bands = Oracle::bands(radiance);
        double off = 0, largest = 0;
        for (size_t b = 0; b < bands.size(); ++b) {
            const double right = bands[b] / static_cast<double>(pattern.x.size());
            off = std::max(off, std::abs(found[p].bands[b] - right));
            largest = std::max(largest, right);
        }
        if (seen == 3) {
            if (!edge) CHECK(off == 0);
            continue;
        }
        const auto shape = static_cast<size_t>(seen);
        double& of = edge ? outline[shape] : grazing >= 0.5 ? inside[shape] : rim[shape];
        of = std::max(of, off / largest);
        judged[shape] += !edge;
    }
    // Balls of 27 pixels are cut into triangles that keep a tenth of a pixel; their normals lean by as much,
    // which the sun's cosine and, at the rim, Fresnel's slope show. The wall is flat: what is left of it are
    // texels in float and this test's own steps over wavelengths.
    constexpr std::array<double, 3> insideMost{2e-4, 2.5e-3, 1e-5}, rimMost{5e-3, 0.025, 1e-5},
        outlineMost{0.03, 0.08, 0.08};
    for (size_t shape : {0, 1, 2}) {
        CAPTURE(shape, judged[shape], inside[shape], rim[shape], outline[shape]);
        CHECK(judged[shape] > 100);
        CHECK(inside[shape] < insideMost[shape]);
        CHECK(rim[shape] < rimMost[shape]);
        CHECK(outline[shape] < outlineMost[shape]);
    }
}
