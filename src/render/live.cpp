#include "render/live.h"

#include "base/stopped.h"
#include "render/light_groups.h"
#include "render/memory_plan.h"

#include <algorithm>
#include <cstring>

namespace spectrad {

ShownThrough shownThrough(const Matrix3& toSignals, const Display& display) {
    ShownThrough through;
    // Previews are linear Rec.709 without the 683 lm/W.
    const Matrix3 matrix =
        toSignals * srgbDisplay().toXyz * diagonal({luminousEfficacy, luminousEfficacy, luminousEfficacy});
    for (size_t i = 0; i < 9; ++i)
        through.matrix[i] = static_cast<float>(matrix[i / 3][i % 3]);
    constexpr double codes = 255;
    for (int code = 0; code < 255; ++code)
        through.threshold.push_back(static_cast<float>(decode(display, (code + 0.5) / codes)));
    for (int cell = 0; cell < SD_SHOW_CELLS; ++cell) {
        const float from = static_cast<float>(cell) / SD_SHOW_CELLS;
        const auto above = std::upper_bound(through.threshold.begin(), through.threshold.end(), from);
        through.start.push_back(static_cast<std::uint8_t>(above - through.threshold.begin()));
    }
    return through;
}

LiveImage::LiveImage(const Device& device, Plan plan) : device_(device), plan_(std::move(plan)) {
    const Affine cameraToWorld = inverse(plan_.view.worldToCamera);
    for (const sd_draw& draw : plan_.world.draws) {
        Affine toCamera;
        std::copy(std::begin(draw.to_camera), std::end(draw.to_camera), toCamera.m.begin());
        drawToWorld_.push_back(cameraToWorld * toCamera);
    }
}

LiveImage::Pipeline& LiveImage::pipeline(int samples) {
    const auto [found, fresh] = pipelines_.try_emplace(samples);
    Pipeline& made = found->second;
    if (!fresh) return made;
    try {
        made.plan = withSamples(plan_, samples);
        made.lanes = lanePattern(samples, device_.body().vectorWidth());
        made.stages = std::make_unique<Stages>(device_, made.plan, made.lanes);
    } catch (...) {
        pipelines_.erase(found);
        throw;
    }
    // The stages read no vertex after this.
    World& world = made.plan.world;
    world.position = world.normal = world.uv = {};
    world.index = world.triangleMaterial = world.vertexDraw = world.casters = {};
    return made;
}

void LiveImage::move(const View& view, const Scene& scene, const FlatScene& flat) {
    plan_.view = view;
    for (size_t i = 0; i < drawToWorld_.size(); ++i)
        plan_.world.draws[i] = drawOf(view.worldToCamera * drawToWorld_[i]);
    placeLights(scene, flat, view, plan_.world.lights);
    for (auto& [samples, made] : pipelines_) {
        made.plan.view = view;
        made.stages->move(view, plan_.world.draws, plan_.world.lights);
        made.moved = true;
    }
    current_ = nullptr;
}

void LiveImage::wear(Plan shading) {
    World& now = plan_.world;
    World& then = shading.world;
    now.materials = std::move(then.materials);
    now.lobes = std::move(then.lobes);
    now.tables = std::move(then.tables);
    now.lights = std::move(then.lights);
    now.textures = std::move(then.textures);
    now.texels = std::move(then.texels);
    now.resident = std::move(then.resident);
    plan_.terms = std::move(shading.terms);
    plan_.groups = shading.groups;
    plan_.features = std::move(shading.features);
    plan_.defines = std::move(shading.defines);
    plan_.whiteName = std::move(shading.whiteName);
    plan_.white = shading.white;
    plan_.labWhiteName = std::move(shading.labWhiteName);
    plan_.labWhite = shading.labWhite;
    current_ = nullptr;
    strips_.clear();
    pipelines_.clear();
}

void LiveImage::resolve(int samples, const std::stop_token& stop) {
    Pipeline& wanted = pipeline(samples);
    if (current_ == &wanted) return;
    current_ = nullptr;
    if (!seen_.expired()) strips_.clear();  // theirs stay theirs
    seen_.reset();
    if (wanted.moved) {
        wanted.stages->transform();
        wanted.rows = planMemory(wanted.plan, device_.info(), wanted.lanes.slots).visibilityRows;
        wanted.moved = false;
    }
    const int height = plan_.view.height;
    size_t count = 0;
    for (int row = 0; row < height;) {
        throwIfStopped(stop);
        if (count == strips_.size()) strips_.emplace_back();
        wanted.stages->exchange(strips_[count]);
        const int rows = std::min(wanted.rows, height - row);
        const bool fits = wanted.stages->light(row, rows);
        wanted.stages->exchange(strips_[count]);
        if (!fits) {
            if (rows <= 1) throw MachineError("the terms of one row do not fit into the device's memory");
            wanted.rows = std::max(1, rows / 2);
            continue;
        }
        row += rows;
        ++count;
    }
    strips_.resize(count);
    current_ = &wanted;
}

template <typename See>
void LiveImage::eachStrip(See see) {
    if (!current_) throw std::logic_error("an image is shown before it is resolved");
    for (TermImage& strip : strips_) {
        const int firstRow = strip.firstRow, rows = strip.rows;
        current_->stages->exchange(strip);
        try {
            see(firstRow, rows);
        } catch (...) {
            current_->stages->exchange(strip);
            throw;
        }
        current_->stages->exchange(strip);
    }
}

void LiveImage::show(const std::vector<float>& colours, const ShownThrough& through,
                     std::vector<std::uint32_t>& pixels) {
    const auto width = static_cast<size_t>(plan_.view.width);
    pixels.resize(width * static_cast<size_t>(plan_.view.height));
    eachStrip([&](int firstRow, int rows) {
        Stages& stages = *current_->stages;
        stages.show(colours, through, pixels_);
        const auto pitch = static_cast<size_t>(stages.pitch());
        const MappedFloats map(device_, pixels_.buffer(), static_cast<size_t>(rows) * pitch);
        for (size_t row = 0; row < static_cast<size_t>(rows); ++row)
            std::memcpy(pixels.data() + (static_cast<size_t>(firstRow) + row) * width,
                        map.data() + row * pitch, width * sizeof(std::uint32_t));
    });
}

ChannelImage LiveImage::xyz(const std::vector<float>& colours) {
    static const Matrix3 toXyz = srgbDisplay().toXyz;
    const auto width = static_cast<size_t>(plan_.view.width);
    ChannelImage image(plan_.view.width, plan_.view.height, 3);
    eachStrip([&](int firstRow, int rows) {
        Stages& stages = *current_->stages;
        stages.expandPreview(colours, preview_);
        const auto pitch = static_cast<size_t>(stages.pitch());
        const MappedFloats map(device_, preview_.buffer(), static_cast<size_t>(rows) * 3 * pitch);
        for (size_t row = 0; row < static_cast<size_t>(rows); ++row)
            for (size_t x = 0; x < width; ++x) {
                const float* rgb = map.data() + row * 3 * pitch + x;
                const Triple xyz = toXyz * Triple{rgb[0], rgb[pitch], rgb[2 * pitch]};
                for (size_t c = 0; c < 3; ++c)
                    image.plane[c][(static_cast<size_t>(firstRow) + row) * width + x] =
                        luminousEfficacy * xyz[c];
            }
    });
    return image;
}

std::shared_ptr<const SeenTerms> LiveImage::seen() {
    if (!current_) return nullptr;
    if (auto there = seen_.lock()) return there;
    // Another queue does not wait for this one.
    checked(device_.body(), "lighting", [&] { device_.body().queue.finish(); });
    const auto made = std::make_shared<SeenTerms>();
    made->width_ = plan_.view.width;
    made->pitch_ = current_->stages->pitch();
    checked(device_.body(), "keeping what is seen", [&] {
        for (const TermImage& strip : strips_)
            made->strips_.push_back(
                {strip.firstRow, strip.rows, strip.first.buffer(), strip.term.buffer(), strip.g.buffer()});
    });
    seen_ = made;
    return made;
}

std::vector<std::pair<std::uint32_t, float>> SeenTerms::at(const Device& reader, int x, int y) const {
    std::vector<std::pair<std::uint32_t, float>> terms;
    const auto strip = std::find_if(strips_.begin(), strips_.end(), [y](const Strip& image) {
        return y >= image.firstRow && y < image.firstRow + image.rows;
    });
    if (strip == strips_.end() || x < 0 || x >= width_) return terms;
    const auto block = static_cast<size_t>((y - strip->firstRow) * (pitch_ / SD_BLOCK) + x / SD_BLOCK);
    const auto read = [&](const cl::Buffer& buffer, size_t from, auto& out) {
        readElements(reader, buffer, from, out.size(), out.data(), "reading a pixel's terms");
    };
    std::vector<std::uint32_t> range(2);
    read(strip->first, block, range);
    std::vector<std::uint32_t> number(range[1] - range[0]);
    std::vector<float> g(number.size() * SD_BLOCK);
    read(strip->term, range[0], number);
    read(strip->g, size_t{range[0]} * SD_BLOCK, g);
    for (size_t t = 0; t < number.size(); ++t)
        terms.emplace_back(number[t], g[t * SD_BLOCK + static_cast<size_t>(x % SD_BLOCK)]);
    return terms;
}

std::optional<std::uint32_t> LiveImage::triangleAt(int x, int y) {
    if (!current_ || x < 0 || y < 0 || x >= plan_.view.width || y >= plan_.view.height) return std::nullopt;
    Stages& stages = *current_->stages;
    stages.cover(y, 1);
    std::uint64_t key = 0;
    const auto sample = static_cast<size_t>(x) * static_cast<size_t>(current_->lanes.slots);
    stages.keys().read(device_, &key, 1, "reading what a pixel sees", sample);
    constexpr std::uint32_t nothing = 0xffffffff;
    const auto triangle = static_cast<std::uint32_t>(key);
    return triangle == nothing ? std::nullopt : std::optional(triangle);
}

}  // namespace spectrad
