// Shadow rays: every sample of a picture asks whether its light is hidden, beside Embree asked the same rays,
// sixteen at a time from as many threads. Both answers are compared.
#include "base/files.h"
#include "base/parallel.h"
#include "measure.h"
#include "opencl/device_body.h"
#include "render/casters.h"
#include "render/stages.h"
#include "scene/load.h"
#include "spectrum/library.h"
#include "verify/scalar_shadow.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <unistd.h>

#ifdef SPECTRAD_EMBREE
#include <embree3/rtcore.h>
#endif

using namespace spectrad;

namespace {

constexpr int width = 1280, height = 720, samples = 4;

/// `side` × `side` teapots on a floor under one lamp.
std::string teapots(int side, bool shadows) {
    std::string text = fmt::format(
        R"(<scene version="1" shadows="{}"><wavelengths>550</wavelengths>
<material name="m"><diffuse reflectance="constant:0.5"/></material>
<node rotate="1 0 0 -90"><plane size="60 60" material="m"/></node>
<light type="point" position="6 12 7" spectrum="constant:1" scale="100"/>
<camera fov="40" look-from="0 {} {}" look-at="0 0 0" size="{}x{}"/>
)",
        shadows, 1.6 * side, 1.6 * side, width, height);
    for (int i = 0; i < side * side; ++i)
        text += fmt::format(
            "<node translate=\"{} 0 {}\" rotate=\"0 1 0 {}\"><teapot size=\"1\" material=\"m\"/></node>\n",
            1.8 * (i % side - 0.5 * (side - 1)), 1.8 * (i / side - 0.5 * (side - 1)), 37 * i % 360);
    return text + "</scene>\n";
}

Plan planFor(int side, bool shadows, const Library& library) {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / fmt::format("spectrad-bench-{}.xml", getpid());
    writeFile(file, teapots(side, shadows));
    Notes notes;
    RenderSettings settings;
    settings.samples = samples;
    Plan plan = makePlan(loadScene(file, library, {}, notes), settings, library, notes);
    std::filesystem::remove(file);
    return plan;
}

struct Ray {
    std::array<float, 3> from, along;  ///< to the light
    bool asked;
};

/// Of every sample, in the order of the picture's vectors: what the kernels ask.
std::vector<Ray> raysOf(const Device& device, const Plan& plan, const Stages& stages,
                        const LanePattern& lanes) {
    const sd_frame frame = scalar::frameOf(plan);
    const auto vertices = scalar::transform<float>(plan.world, frame);
    const auto slots = static_cast<size_t>(lanes.slots);
    std::vector<std::uint64_t> keys(static_cast<size_t>(frame.pitch) * static_cast<size_t>(height) * slots);
    stages.keys().read(device, keys.data(), keys.size(), "reading the samples", 0);
    const sd_light& light = plan.world.lights.front();
    std::vector<Ray> rays(keys.size());
    inParallel(static_cast<size_t>(height), [&](size_t row) {
        const size_t line = static_cast<size_t>(frame.pitch) * slots;
        for (size_t i = 0; i < line; ++i) {
            Ray& ray = rays[row * line + i];
            const auto triangle = static_cast<std::uint32_t>(keys[row * line + i]);
            ray.asked = triangle != scalar::noTriangle;
            if (!ray.asked) continue;
            const auto x = static_cast<float>(static_cast<int>(i / slots) * SD_SUBPIXEL -
                                              width * (SD_SUBPIXEL / 2) + lanes.slotX[i % slots]),
                       y = static_cast<float>(static_cast<int>(row) * SD_SUBPIXEL -
                                              height * (SD_SUBPIXEL / 2) + lanes.slotY[i % slots]);
            const auto s = scalar::surfaceAt<float>(plan.world, vertices, frame, triangle, x, y);
            ray.from = {s.lifted.x, s.lifted.y, s.lifted.z};
            ray.along = {light.x - s.lifted.x, light.y - s.lifted.y, light.z - s.lifted.z};
            ray.asked = s.normal.x * ray.along[0] + s.normal.y * ray.along[1] + s.normal.z * ray.along[2] > 0;
        }
    });
    return rays;
}

#ifdef SPECTRAD_EMBREE
class Embree {
  public:
    explicit Embree(const Plan& plan) : device_(rtcNewDevice("threads=2")), scene_(rtcNewScene(device_)) {
        const auto vertices = scalar::transform<float>(plan.world, scalar::frameOf(plan));
        RTCGeometry mesh = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* corners = static_cast<float*>(rtcSetNewGeometryBuffer(
            mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, vertices.camera.size() / 3));
        std::copy(vertices.camera.begin(), vertices.camera.end(), corners);
        auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, plan.world.index.size() / 3));
        std::copy(plan.world.index.begin(), plan.world.index.end(), index);
        rtcCommitGeometry(mesh);
        rtcAttachGeometry(scene_, mesh);
        rtcReleaseGeometry(mesh);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);  // as ours: nothing slips through edges
    }
    ~Embree() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    Embree(const Embree&) = delete;
    Embree& operator=(const Embree&) = delete;

    void build() { rtcCommitScene(scene_); }
    void ask(const std::vector<Ray>& rays, std::vector<char>& hidden) const {
        hidden.resize(rays.size());
        constexpr size_t chunk = 16 * 1024;
        inParallel((rays.size() + chunk - 1) / chunk, [&](size_t part) {
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
            for (size_t i = part * chunk; i < std::min(rays.size(), (part + 1) * chunk); i += 16) {
                alignas(64) RTCRay16 packet;
                alignas(64) std::array<int, 16> valid;
                for (size_t k = 0; k < 16; ++k) {
                    const Ray& ray = rays[i + k];
                    valid[k] = ray.asked ? -1 : 0;
                    packet.org_x[k] = ray.from[0], packet.org_y[k] = ray.from[1],
                    packet.org_z[k] = ray.from[2];
                    packet.dir_x[k] = ray.along[0], packet.dir_y[k] = ray.along[1],
                    packet.dir_z[k] = ray.along[2];
                    packet.tnear[k] = 0, packet.tfar[k] = 1;
                    packet.mask[k] = ~0u, packet.flags[k] = 0, packet.time[k] = 0, packet.id[k] = 0;
                }
                rtcOccluded16(valid.data(), scene_, &context, &packet);
                for (size_t k = 0; k < 16; ++k)
                    hidden[i + k] = valid[k] && packet.tfar[k] < 0;
            }
        });
    }

  private:
    RTCDevice device_;
    RTCScene scene_;
};
#endif

void run(int rounds) {
    const Device device = Device::open(std::nullopt);
    const Library library = Library::open();
    fmt::print("device: {}; {} x {} pixels, {} samples each\n", device.info().name, width, height, samples);
    for (const int side : {1, 6, 24}) {
        const Plan with = planFor(side, true, library), without = planFor(side, false, library);
        const LanePattern lanes = lanePattern(samples, device.body().vectorWidth());
        Stages shadowed(device, with, lanes), plain(device, without, lanes);
        World unordered = with.world;
        const auto ordered = [&] { orderCasters(unordered); };
        const auto moved = [&](Stages& stages) { stages.transform(), device.body().queue.finish(); };
        const auto lit = [&](Stages& stages) { stages.light(0, height), device.body().queue.finish(); };
        moved(shadowed), moved(plain);
        shadowed.cover(0, height);
        const std::vector<Ray> rays = raysOf(device, with, shadowed, lanes);
        const auto asked = static_cast<double>(
            std::count_if(rays.begin(), rays.end(), [](const Ray& r) { return r.asked; }));
        std::vector<std::function<void()>> contestants{[&] { moved(plain); }, [&] { moved(shadowed); },
                                                       [&] { lit(plain); }, [&] { lit(shadowed); }, ordered};
#ifdef SPECTRAD_EMBREE
        Embree embree(with);
        embree.build();
        std::vector<char> hidden;
        contestants.emplace_back([&] { embree.ask(rays, hidden); });
#endif
        const std::vector<bench::Times> times = bench::inTurn(contestants, rounds);
        const auto ms = [&](size_t i) { return 1e3 * times[i].typical(); };
        const double seconds = times[3].typical() - times[2].typical();
        fmt::print(
            "{:8} triangles | order {:.1f} ms, boxes {:.2f} ms (transform {:.2f}) | lighting {:.1f} ms, with "
            "shadows {:.1f}: "
            "{:.1f} M rays/s",
            with.triangles(), ms(4), ms(1) - ms(0), ms(0), ms(2), ms(3), asked / seconds * 1e-6);
#ifdef SPECTRAD_EMBREE
        const scalar::OccludersOf<float> occluders(
            with.world, scalar::transform<float>(with.world, scalar::frameOf(with)));
        std::vector<char> ours(rays.size());
        inParallel(rays.size() / 1024, [&](size_t part) {
            for (size_t i = part * 1024; i < (part + 1) * 1024; ++i)
                ours[i] =
                    rays[i].asked && occluders.hides(with.world.lights.front(),
                                                     {rays[i].from[0], rays[i].from[1], rays[i].from[2]});
        });
        size_t dark = 0, different = 0;
        for (size_t i = 0; i < ours.size(); ++i)
            dark += ours[i], different += ours[i] != hidden[i];
        fmt::print(
            " | Embree {:.1f} M rays/s, {:.2f} times as fast; of {:.1f} M rays {:.1f} % hidden, {} answered "
            "otherwise",
            asked / times[5].typical() * 1e-6, seconds / times[5].typical(), asked * 1e-6,
            100.0 * static_cast<double>(dark) / asked, different);
#endif
        fmt::print("\n");
        std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
    return bench::reported([&] { run(bench::roundsFrom(argc, argv)); });
}
