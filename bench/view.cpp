// The viewer: a frame of a moving camera beside llvmpipe (OSMesa) drawing the same triangles in RGB, another
// illuminant, and both with 31 and with 401 bands.
#include "measure.h"
#include "viewer/viewer.h"
#ifdef SPECTRAD_OSMESA
#include "llvmpipe.h"
#endif

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <unistd.h>

using namespace spectrad;

namespace {

constexpr int width = 1280, height = 720;

/// A folder of the benchmark's own.
class Folder {
  public:
    Folder() : path_(std::filesystem::temp_directory_path() / fmt::format("spectrad-bench-{}", ::getpid())) {
        std::filesystem::create_directories(path_);
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// A dented ball of 2 · 250 · 125 triangles.
void writeBall(const std::filesystem::path& file) {
    constexpr int around = 250, up = 125;
    constexpr double pi = 3.14159265358979323846;
    std::ofstream out(file);
    for (int j = 0; j <= up; ++j)
        for (int i = 0; i < around; ++i) {
            const double a = 2 * pi * i / around, b = pi * (j + 0.001) / (up + 0.002);
            const double r = 0.9 + 0.1 * std::sin(9 * a) * std::sin(7 * b);
            out << fmt::format("v {} {} {}\n", r * std::sin(b) * std::cos(a), r * std::cos(b),
                               r * std::sin(b) * std::sin(a));
        }
    for (int j = 0; j < up; ++j)
        for (int i = 0; i < around; ++i) {
            const int p = j * around + i + 1, q = j * around + (i + 1) % around + 1;
            out << fmt::format("f {} {} {}\nf {} {} {}\n", p, q, q + around, p, q + around, p + around);
        }
}

/// Sixteen such balls in four paints under one lamp: a million triangles.
std::filesystem::path writeScene(const std::filesystem::path& folder) {
    writeBall(folder / "ball.obj");
    std::ofstream out(folder / "scene.xml");
    out << "<scene version=\"1\">\n";
    const std::array<const char*, 4> paints{"red", "green", "blue", "yellow"};
    for (const char* paint : paints)
        out << fmt::format(
            "<material name=\"{0}\"><diffuse reflectance=\"charts/colorchecker/{0}\"/></material>\n", paint);
    for (int i = 0; i < 16; ++i)
        out << fmt::format(
            "<node translate=\"{} {} {}\"><mesh file=\"ball.obj\" material=\"{}\" "
            "normals=\"smooth\"/></node>\n",
            1.6 * (i % 4) - 2.4, 1.6 * (i / 4) - 2.4, -0.7 * ((i * 7) % 5),
            paints[static_cast<size_t>(i) % 4]);
    out << fmt::format(
        "<light name=\"lamp\" type=\"point\" position=\"0 0 9\" spectrum=\"illuminants/D65\" "
        "intensity=\"3000 cd\"/>\n<camera fov=\"40\" look-from=\"0 0 9\" look-at=\"0 0 0\" size=\"{}x{}\"/>\n"
        "</scene>\n",
        width, height);
    return folder / "scene.xml";
}

/// A viewer off screen, with its picture settled.
class Desk {
  public:
    Desk(const std::filesystem::path& scene, const Device& device, const Library& library,
         const char* wavelengths, bool panels)
        : session_(
              [=, &library](Notes& notes) {
                  RenderSettings settings;
                  settings.wavelengths = parseWavelengths(wavelengths, {});
                  return std::make_unique<view::SceneSubject>(scene, LoadOptions{}, settings, device, library,
                                                              notes);
              },
              library, notes_),
          face_(view::openOffscreen(width, height)),
          viewer_(*face_, session_) {
        viewer_.showPanels(panels);
        (void)viewer_.picture();
    }

    [[nodiscard]] view::Session& session() { return session_; }
    [[nodiscard]] view::SceneSubject& scene() { return *session_.scene(); }
    /// A frame with the camera in the user's hand.
    void drag() {
        bind();
        if (!held_) play("move 640 700\npress\n");
        held_ = true;
        play(fmt::format("move {} 700\n", 640 + (++moves_ % 200)));
    }
    /// Lets go: the picture gets its samples.
    void rest() {
        bind();
        if (held_) play("release\n");
        held_ = false;
        (void)viewer_.picture();
    }
    /// Another lamp in a picture that has all its samples.
    void relight() {
        bind();
        session_.set(++moves_ % 2 == 0 ? "lamp.spectrum=illuminants/D65" : "lamp.spectrum=illuminants/FL11");
        viewer_.frame(0);
    }

  private:
    /// Another context may have been current since.
    void bind() { face_->resize(width, height); }
    void play(const std::string& script) { view::run(viewer_, view::parseScript(script, "bench"), 0); }

    Notes notes_;
    view::Session session_;
    std::unique_ptr<view::Face> face_;
    view::Viewer viewer_;
    bool held_ = false;
    int moves_ = 0;
};

#ifdef SPECTRAD_OSMESA
/// The same triangles, in the world's space.
Plan inWorld(const Plan& given) {
    Plan plan = given;
    const Affine toWorld = inverse(given.view.worldToCamera);
    std::vector<Affine> place;
    for (const sd_draw& draw : given.world.draws) {
        Affine toCamera;
        std::copy(std::begin(draw.to_camera), std::end(draw.to_camera), toCamera.m.begin());
        place.push_back(toWorld * toCamera);
    }
    for (size_t v = 0; v < plan.world.vertexDraw.size(); ++v) {
        float* p = plan.world.position.data() + 3 * v;
        const Vec3 at = place[plan.world.vertexDraw[v]].point({p[0], p[1], p[2]});
        p[0] = static_cast<float>(at.x);
        p[1] = static_cast<float>(at.y);
        p[2] = static_cast<float>(at.z);
    }
    return plan;
}

Affine worldToCamera(const view::Pose& pose) {
    return inverse(Affine::lookAt(pose.eye, pose.target, pose.up));
}
#endif

void print(const std::string& what, const bench::Times& times) {
    fmt::print("{:46} {:8.2f} ms, best {:8.2f} ms, work {:8.2f} ms\n", what, times.typical() * 1e3,
               times.best() * 1e3, bench::median(times.work) * 1e3);
    std::fflush(stdout);
}

constexpr const char *fewBands = "400:700:10", *manyBands = "380:780:1";

/// One after the other, several times, so that both find the memory in the same state.
void compareBands(const std::filesystem::path& scene, const Device& device, const Library& library,
                  int rounds) {
    std::array<bench::Times, 2> frames, lamps;
    constexpr int turns = 4;
    for (int turn = 0; turn < turns; ++turn)
        for (size_t which = 0; which < 2; ++which) {
            Desk desk(scene, device, library, which == 0 ? fewBands : manyBands, false);
            const auto add = [](bench::Times& all, const bench::Times& more) {
                all.rounds.insert(all.rounds.end(), more.rounds.begin(), more.rounds.end());
                all.work.insert(all.work.end(), more.work.begin(), more.work.end());
            };
            add(frames[which], bench::inTurn({[&] { desk.drag(); }}, rounds)[0]);
            desk.rest();
            add(lamps[which], bench::inTurn({[&] { desk.relight(); }}, rounds)[0]);
        }
    for (const auto& [what, times] : {std::pair{"moving camera", &frames}, {"another illuminant", &lamps}}) {
        print(fmt::format("{}, 31 bands", what), (*times)[0]);
        print(fmt::format("{}, 401 bands", what), (*times)[1]);
        const bench::Ratio r = bench::ratio((*times)[1], (*times)[0]);
        fmt::print("31 bands take {:.3f} times as long as 401 (best {:.3f}, work {:.3f})\n", r.typical,
                   r.best, r.work);
    }
}

void run(int rounds) {
    const Folder folder;
    const Library library = Library::open();
    const Device device = Device::open(std::nullopt);
    const std::filesystem::path scene = writeScene(folder.path());
    auto plain = std::make_unique<Desk>(scene, device, library, fewBands, false),
         panels = std::make_unique<Desk>(scene, device, library, fewBands, true);
    fmt::print("device: {}\n{} triangles, {} x {} pixels\n", device.info().name,
               plain->scene().plan().triangles(), width, height);

    std::vector<std::function<void()>> moving{[&] { plain->drag(); }, [&] { panels->drag(); }};
#ifdef SPECTRAD_OSMESA
    bench::Llvmpipe theirs(inWorld(plain->scene().plan()), 1, true);
    moving.emplace_back([&] {
        theirs.look(worldToCamera(plain->session().stand.pose));
        theirs.draw();
    });
#endif
    const std::vector<bench::Times> frames = bench::inTurn(moving, rounds);
    print("moving camera", frames[0]);
    print("moving camera, with panels", frames[1]);
#ifdef SPECTRAD_OSMESA
    print("the same triangles in RGB, " + theirs.name().substr(0, 8), frames[2]);
    const bench::Ratio r = bench::ratio(frames[0], frames[2]), p = bench::ratio(frames[1], frames[2]);
    fmt::print(
        "times as fast as RGB: {:.2f} (best {:.2f}, work {:.2f}); with panels {:.2f} (best {:.2f}, "
        "work {:.2f})\n",
        r.typical, r.best, r.work, p.typical, p.best, p.work);
#endif
    plain->rest();
    panels->rest();
    const std::vector<bench::Times> lamps =
        bench::inTurn({[&] { plain->relight(); }, [&] { panels->relight(); }}, rounds);
    print("another illuminant, 16 samples", lamps[0]);
    print("another illuminant, 16 samples, with panels", lamps[1]);
    plain.reset();
    panels.reset();
    compareBands(scene, device, library, rounds);
}

}  // namespace

int main(int argc, char** argv) {
    return bench::reported([&] { run(bench::roundsFrom(argc, argv)); });
}
