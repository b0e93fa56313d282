#include "render/stages.h"

#include "render/casters.h"
#include "render/resident.h"

#include <algorithm>

namespace spectrad {

namespace {

bool showsOnePass(const World& world) {
    return world.texels.empty() && world.resident.size() == 1;
}

std::vector<std::string> withDevice(std::vector<std::string> defines, const Device& device) {
    defines.push_back(vectorDefine(device));
    if (device.info().platform == "Portable Computing Language" && device.info().type == "cpu")
        defines.emplace_back("PREFETCH");
    return defines;
}

/// Coverage depends on the number of sample slots, and on what lies on the screen: the program is shared by
/// all plans that agree on it.
std::vector<std::string> geometryDefines(const Plan& plan, const Device& device) {
    std::vector<std::string> defines;
    for (const std::string& define : plan.defines)
        if (define.starts_with("SLOTS=") || define == "BAKE" || define == "CONTRACT" || define == "FAST_MATH")
            defines.push_back(define);
    return withDevice(defines, device);
}

/// For each term the first band and the end of the bands in which it is not zero.
std::vector<std::uint32_t> spansOf(const std::vector<float>& spectra, size_t bands) {
    std::vector<std::uint32_t> spans;
    for (size_t from = 0; from < spectra.size(); from += bands) {
        std::uint32_t first = 0, end = static_cast<std::uint32_t>(bands);
        while (end > first && spectra[from + end - 1] == 0)
            --end;
        while (first < end && spectra[from + first] == 0)
            ++first;
        spans.push_back(first);
        spans.push_back(end);
    }
    return spans;
}

/// Pixels from row to row: whole blocks.
int pitchOf(int width) {
    return (width + SD_BLOCK - 1) / SD_BLOCK * SD_BLOCK;
}

void setView(sd_frame& frame, const View& view) {
    frame.pixels_per_slope = view.pixelsPerSlope;
    frame.slope_per_subpixel = static_cast<float>(1 / (SD_SUBPIXEL * view.pixelsPerSlope));
    frame.orthographic = view.orthographic;
    frame.baked = view.baked;
    const Affine toWorld = inverse(view.worldToCamera);
    for (size_t row = 0; row < 3; ++row)
        for (size_t column = 0; column < 3; ++column)
            frame.to_world[3 * row + column] = static_cast<float>(toWorld.m[4 * row + column]);
    frame.width = view.width;
    frame.height = view.height;
    frame.pitch = pitchOf(view.width);
}

sd_frame makeFrame(const Plan& plan, const LanePattern& lanes) {
    sd_frame frame{};
    setView(frame, plan.view);
    frame.samples = plan.samples;
    constexpr int maxTileSide = 32;  // what the edge functions of cover_tiles can cross in 32 bits
    const auto fits = [&](int side) {
        return side <= maxTileSide && side * side * lanes.slots <= SD_TILE_SAMPLES;
    };
    while (fits(2 << frame.tile_shift))
        ++frame.tile_shift;
    return frame;
}

}  // namespace

Stages::Stages(const Device& device, const Plan& plan, const LanePattern& lanes)
    : device_(device),
      plan_(plan),
      frame_(makeFrame(plan, lanes)),
      triangles_(static_cast<std::uint32_t>(plan.triangles())),
      vertices_(static_cast<std::uint32_t>(plan.world.vertexDraw.size())),
      casterCount_(static_cast<std::uint32_t>(plan.world.casters.size())),
      words_(static_cast<std::uint32_t>((plan.world.materials.size() + 31) / 32)),
      slots_(static_cast<size_t>(lanes.slots)),
      geometry_(device, {"transform.cl", "clear.cl", "small.cl", "clip.cl", "tiles.cl", "bounds.cl"},
                geometryDefines(plan, device)),
      shading_(device, {"materials.cl", "light.cl", "expand.cl", "show.cl"},
               withDevice(plan.defines, device)),
      transform_(geometry_.kernel("transform")),
      tangents_(geometry_.kernel("transform_tangents")),
      clear_(geometry_.kernel("clear_keys")),
      small_(geometry_.kernel("cover_small")),
      setup_(geometry_.kernel("setup_large")),
      clip_(geometry_.kernel("clip_triangles")),
      count_(geometry_.kernel("count_tiles")),
      scan_(geometry_.kernel("scan")),
      deal_(geometry_.kernel("deal_tiles")),
      tiles_(geometry_.kernel("cover_tiles")),
      boundLeaves_(geometry_.kernel("bound_leaves")),
      boundNodes_(geometry_.kernel("bound_nodes")),
      find_(shading_.kernel("find_materials")),
      scanTerms_(shading_.kernel("scan_terms")),
      list_(shading_.kernel("list_terms")),
      light_(shading_.kernel("light_block")),
      expand_(shading_.kernel("expand")),
      show_(shading_.kernel("show")) {
    uploadWorld();
    laneX_.upload(device_, lanes.laneX.data(), lanes.laneX.size(), "the sample pattern");
    laneY_.upload(device_, lanes.laneY.data(), lanes.laneY.size(), "the sample pattern");
    used_.upload(device_, lanes.used.data(), lanes.used.size(), "the sample pattern");
}

const cl::Buffer& Stages::texels() const {
    return showsOnePass(plan_.world) ? plan_.world.resident.front().texels->values.buffer()
                                     : ownTexels_.buffer();
}

/// All texels in one buffer: the host's, then those that are on the device already. A single texture of a
/// pass is read where it is.
void Stages::uploadTextures() {
    const World& world = plan_.world;
    std::vector<sd_texture> textures = world.textures;
    size_t total = world.texels.size();
    for (const World::Resident& part : world.resident) {
        textures[part.texture].first = total;
        total += part.texels->count(textures[part.texture].levels);
    }
    textures_.upload(device_, textures.data(), textures.size(), "the textures");
    if (showsOnePass(world)) return;
    ownTexels_.reserve(device_, total, "the textures");
    checked(device_.body(), "uploading the textures", [&] {
        const cl::CommandQueue& queue = device_.body().queue;
        if (!world.texels.empty())
            queue.enqueueWriteBuffer(texels(), CL_TRUE, 0, world.texels.size() * sizeof(float),
                                     world.texels.data());
        for (const World::Resident& part : world.resident)
            queue.enqueueCopyBuffer(part.texels->values.buffer(), texels(), 0,
                                    textures[part.texture].first * sizeof(float),
                                    part.texels->count(textures[part.texture].levels) * sizeof(float));
    });
}

void Stages::uploadWorld() {
    uploadTextures();
    const World& world = plan_.world;
    const auto up = [this](auto& array, const auto& data, const char* what) {
        array.upload(device_, data.data(), data.size(), what);
    };
    up(position_, world.position, "the scene's vertices");
    up(normal_, world.normal, "the scene's normals");
    up(tangent_, world.tangent, "the scene's tangents");
    up(vertexDraw_, world.vertexDraw, "the scene's vertices");
    up(draws_, world.draws, "the scene's placements");
    up(index_, world.index, "the scene's triangles");
    up(triangleMaterial_, world.triangleMaterial, "the scene's triangles");
    up(casters_, world.casters, "what throws shadows");
    bounds_.reserve(device_, std::max<size_t>(size_t{12} * leavesOf(casterCount_), 1), "what throws shadows");
    up(materials_, world.materials, "the materials");
    up(lobes_, world.lobes, "the materials");
    up(tables_, world.tables, "the materials' tables");
    up(lights_, world.lights, "the lights");
    up(coordinates_, world.uv, "the scene's texture coordinates");
    up(spans_, spansOf(plan_.terms.spectra, plan_.terms.bands), "the terms' spectra");
    up(previewSpans_, spansOf(plan_.terms.preview, 3), "the terms' colours");
    up(spectra_, plan_.terms.spectra, "the terms' spectra");
    up(previewSpectra_, plan_.terms.preview, "the terms' colours");
    camera_.reserve(device_, size_t{3} * vertices_, "the transformed vertices");
    cameraNormal_.reserve(device_, size_t{3} * vertices_, "the transformed normals");
    cameraTangent_.reserve(device_, std::max<size_t>(world.tangent.size(), 1), "the transformed tangents");
    screen_.reserve(device_, vertices_, "the transformed vertices");
    largeList_.reserve(device_, triangles_, "the lists of triangles");
    clipList_.reserve(device_, triangles_, "the lists of triangles");
    counters_.reserve(device_, 4, "the counters");
    records_.reserve(device_, 1, "the large triangles");
    tileList_.reserve(device_, 1, "the lists of tiles");
    image_.term.reserve(device_, 1, "the term image");
    image_.g.reserve(device_, SD_BLOCK, "the term image");
}

void Stages::transform() {
    transform_.set("position", position_.buffer())
        .set("normal", normal_.buffer())
        .set("draw", vertexDraw_.buffer())
        .set("draws", draws_.buffer())
        .set("coordinates", coordinates_.buffer())
        .set("frame", frame_)
        .set("count", vertices_)
        .set("camera", camera_.buffer())
        .set("camera_normal", cameraNormal_.buffer())
        .set("screen", screen_.buffer())
        .run(vertices_, 64);
    boundCasters();
    if (plan_.world.tangent.empty()) return;
    tangents_.set("tangent", tangent_.buffer())
        .set("draw", vertexDraw_.buffer())
        .set("draws", draws_.buffer())
        .set("count", vertices_)
        .set("camera_tangent", cameraTangent_.buffer())
        .run(vertices_, 64);
}

void Stages::boundCasters() {
    const std::uint32_t leaves = leavesOf(casterCount_);
    if (leaves == 0) return;
    boundLeaves_.set("index", index_.buffer())
        .set("camera", camera_.buffer())
        .set("casters", casters_.buffer())
        .set("caster_count", casterCount_)
        .set("leaves", leaves)
        .set("bounds", bounds_.buffer())
        .run(leaves, 64);
    for (std::uint32_t nodes = leaves / 2; nodes > 0; nodes /= 2)
        boundNodes_.set("first", nodes).set("count", nodes).set("bounds", bounds_.buffer()).run(nodes, 64);
}

std::uint32_t Stages::readNumber(const cl::Buffer& buffer, size_t index) {
    std::uint32_t number = 0;
    readElements(device_, buffer, index, 1, &number, "reading a count");
    return number;
}

void Stages::zero(const cl::Buffer& buffer, size_t words) {
    checked(device_.body(), "clearing counts",
            [&] { device_.body().queue.enqueueFillBuffer(buffer, cl_uint{0}, 0, words * sizeof(cl_uint)); });
}

void Stages::cover(int firstRow, int rows) {
    frame_.first_row = firstRow;
    frame_.rows = rows;
    const size_t keyCount = static_cast<size_t>(rows) * static_cast<size_t>(frame_.pitch) * slots_;
    keys_.reserve(device_, keyCount, "the samples of a strip");
    clear_.set("keys", keys_.buffer())
        .set("count", static_cast<cl_ulong>(keyCount))
        .run((keyCount + 15) / 16, 64);
    if (triangles_ == 0) return;
    zero(counters_.buffer(), 4);
    const bool scalar = device_.body().vectorWidth() == 1;
    small_.set("index", index_.buffer())
        .set("screen", screen_.buffer())
        .set("triangles", triangles_)
        .set("frame", frame_)
        .set("pattern_x", laneX_.buffer())
        .set("pattern_y", laneY_.buffer())
        .set("keys", keys_.buffer())
        .set("large", largeList_.buffer())
        .set("clip", clipList_.buffer())
        .set("counters", counters_.buffer())
        .run(scalar ? triangles_ : (triangles_ + SD_BATCH - 1) / SD_BATCH, scalar ? 64 : 4);
    const std::uint32_t large = readNumber(counters_.buffer(), 0),
                        clipped = readNumber(counters_.buffer(), 1);
    if (large + clipped > 0) coverLarge(large, clipped);
}

void Stages::coverLarge(std::uint32_t large, std::uint32_t clipped) {
    constexpr std::uint32_t pieces = 6;  // of a triangle cut by five planes
    const std::uint32_t capacity = large + pieces * clipped;
    records_.reserve(device_, capacity, "the large triangles");
    std::uint32_t records = large;
    setup_.set("index", index_.buffer())
        .set("screen", screen_.buffer())
        .set("large", largeList_.buffer())
        .set("count", large)
        .set("records", records_.buffer())
        .run(large, 64);
    if (clipped > 0) {
        checked(device_.body(), "counting pieces", [&] {
            device_.body().queue.enqueueFillBuffer(counters_.buffer(), cl_uint{large}, 0, sizeof(cl_uint));
        });
        clip_.set("index", index_.buffer())
            .set("camera", camera_.buffer())
            .set("screen", screen_.buffer())
            .set("clip", clipList_.buffer())
            .set("count", clipped)
            .set("frame", frame_)
            .set("capacity", capacity)
            .set("records", records_.buffer())
            .set("used", counters_.buffer())
            .run(clipped, 16);
        records = std::min(capacity, readNumber(counters_.buffer(), 0));
    }
    if (records == 0) return;
    const int tile = 1 << frame_.tile_shift;
    frame_.tiles_x = (frame_.pitch + tile - 1) / tile;
    frame_.tiles_y = (frame_.rows + tile - 1) / tile;
    const auto tiles = static_cast<std::uint32_t>(frame_.tiles_x * frame_.tiles_y);
    tileCounts_.reserve(device_, tiles, "the tiles");
    tileFirst_.reserve(device_, tiles + 1, "the tiles");
    zero(tileCounts_.buffer(), tiles);
    count_.set("records", records_.buffer())
        .set("count", records)
        .set("frame", frame_)
        .set("tile_counts", tileCounts_.buffer())
        .run(records, 16);
    scan_.set("numbers", tileCounts_.buffer()).set("count", tiles).set("sums", tileFirst_.buffer()).run(1);
    tileList_.reserve(device_, readNumber(tileFirst_.buffer(), tiles), "the lists of tiles");
    deal_.set("records", records_.buffer())
        .set("count", records)
        .set("frame", frame_)
        .set("tile_first", tileFirst_.buffer())
        .set("tile_counts", tileCounts_.buffer())
        .set("tile_list", tileList_.buffer())
        .run(records, 16);
    tiles_.set("records", records_.buffer())
        .set("tile_first", tileFirst_.buffer())
        .set("tile_list", tileList_.buffer())
        .set("frame", frame_)
        .set("pattern_x", laneX_.buffer())
        .set("pattern_y", laneY_.buffer())
        .set("keys", keys_.buffer())
        .run(tiles);
}

bool Stages::light(int firstRow, int rows) {
    cover(firstRow, rows);

    image_.firstRow = firstRow;
    image_.rows = rows;
    image_.blocks = static_cast<std::uint32_t>(rows * (frame_.pitch / SD_BLOCK));
    sets_.reserve(device_, size_t{image_.blocks} * words_, "the materials of blocks");
    blockTerms_.reserve(device_, image_.blocks, "the term image");
    image_.first.reserve(device_, image_.blocks + 1, "the term image");
    find_.set("keys", keys_.buffer())
        .set("triangle_material", triangleMaterial_.buffer())
        .set("materials", materials_.buffer())
        .set("frame", frame_)
        .set("words", words_)
        .set("blocks", image_.blocks)
        .set("sets", sets_.buffer())
        .set("block_terms", blockTerms_.buffer())
        .run(image_.blocks, 16);
    scanTerms_.set("numbers", blockTerms_.buffer())
        .set("count", image_.blocks)
        .set("sums", image_.first.buffer())
        .run(1);
    const size_t terms = readNumber(image_.first.buffer(), image_.blocks);
    if (terms * SD_BLOCK * sizeof(float) > device_.info().maxAllocationBytes) return false;
    image_.term.reserve(device_, terms, "the term image");
    image_.g.reserve(device_, terms * SD_BLOCK, "the term image");
    list_.set("materials", materials_.buffer())
        .set("sets", sets_.buffer())
        .set("words", words_)
        .set("blocks", image_.blocks)
        .set("block_first", image_.first.buffer())
        .set("block_term", image_.term.buffer())
        .run(image_.blocks, 16);
    if (throwShadows(plan_.world.lights))
        light_.set("casters", casters_.buffer())
            .set("caster_count", casterCount_)
            .set("leaves", cl_uint{leavesOf(casterCount_)})
            .set("bounds", bounds_.buffer());
    const bool scalar = device_.body().vectorWidth() == 1;
    light_.set("keys", keys_.buffer())
        .set("index", index_.buffer())
        .set("camera", camera_.buffer())
        .set("camera_normal", cameraNormal_.buffer())
        .set("coordinates", coordinates_.buffer())
        .set("tangents", cameraTangent_.buffer())
        .set("triangle_material", triangleMaterial_.buffer())
        .set("materials", materials_.buffer())
        .set("lobes", lobes_.buffer())
        .set("tables", tables_.buffer())
        .set("lights", lights_.buffer())
        .set("light_count", static_cast<cl_uint>(plan_.world.lights.size()))
        .set("groups", static_cast<cl_uint>(plan_.groups))
        .set("textures", textures_.buffer())
        .set("texels", texels())
        .set("frame", frame_)
        .set("pattern_x", laneX_.buffer())
        .set("pattern_y", laneY_.buffer())
        .set("pattern_used", used_.buffer())
        .set("words", words_)
        .set("blocks", image_.blocks)
        .set("sets", sets_.buffer())
        .set("block_first", image_.first.buffer())
        .set("g", image_.g.buffer())
        .run(size_t{image_.blocks} * (scalar ? SD_BLOCK : 1), scalar ? SD_BLOCK : 1);
    return true;
}

void Stages::expandRows(int from, int rows, const DeviceArray<float>& spectra,
                        const DeviceArray<std::uint32_t>& spans, size_t bands, DeviceArray<float>& out,
                        const char* what) {
    const auto pitch = static_cast<size_t>(frame_.pitch), lines = static_cast<size_t>(rows);
    const auto rowBlocks = static_cast<std::uint32_t>(frame_.pitch / SD_BLOCK);
    const std::uint32_t blocks = rowBlocks * static_cast<std::uint32_t>(rows);
    const bool scalar = device_.body().vectorWidth() == 1;
    out.reserve(device_, lines * bands * pitch, what);
    expand_.set("g", image_.g.buffer())
        .set("block_first", image_.first.buffer())
        .set("block_term", image_.term.buffer())
        .set("spectra", spectra.buffer())
        .set("spans", spans.buffer())
        .set("bands", static_cast<cl_uint>(bands))
        .set("frame", frame_)
        .set("first_block", static_cast<cl_uint>(from) * rowBlocks)
        .set("blocks", blocks)
        .set("out", out.buffer())
        .run(size_t{blocks} * (scalar ? SD_BLOCK : 1), scalar ? SD_BLOCK : 1);
}

void Stages::expand(int from, int rows, DeviceArray<float>& cube, DeviceArray<float>& preview) {
    expandRows(from, rows, spectra_, spans_, plan_.terms.bands, cube, "a strip of the image");
    expandRows(from, rows, previewSpectra_, previewSpans_, 3, preview, "a strip of the preview");
}

void Stages::expandPreview(const std::vector<float>& spectra, DeviceArray<float>& preview) {
    shownColours_.upload(device_, spectra.data(), spectra.size(), "the terms' colours");
    const std::vector<std::uint32_t> spans = spansOf(spectra, 3);
    shownSpans_.upload(device_, spans.data(), spans.size(), "the terms' colours");
    expandRows(0, image_.rows, shownColours_, shownSpans_, 3, preview, "the preview");
}

void Stages::show(const std::vector<float>& spectra, const ShownThrough& through,
                  DeviceArray<std::uint32_t>& pixels) {
    shownColours_.upload(device_, spectra.data(), spectra.size(), "the terms' colours");
    threshold_.upload(device_, through.threshold.data(), through.threshold.size(), "the display's codes");
    codeStart_.upload(device_, through.start.data(), through.start.size(), "the display's codes");
    const bool scalar = device_.body().vectorWidth() == 1;
    pixels.reserve(device_, static_cast<size_t>(image_.rows) * static_cast<size_t>(frame_.pitch),
                   "the picture");
    sd_show matrix{};
    std::copy(through.matrix.begin(), through.matrix.end(), matrix.to_signal);
    show_.set("g", image_.g.buffer())
        .set("block_first", image_.first.buffer())
        .set("block_term", image_.term.buffer())
        .set("colours", shownColours_.buffer())
        .set("matrix", matrix)
        .set("threshold", threshold_.buffer())
        .set("code_start", codeStart_.buffer())
        .set("blocks", image_.blocks)
        .set("out", pixels.buffer())
        .run(size_t{image_.blocks} * (scalar ? SD_BLOCK : 1), scalar ? SD_BLOCK : 1);
}

void Stages::move(const View& view, const std::vector<sd_draw>& draws, const std::vector<sd_light>& lights) {
    setView(frame_, view);
    draws_.upload(device_, draws.data(), draws.size(), "the scene's placements");
    lights_.upload(device_, lights.data(), lights.size(), "the lights");
}

MappedFloats::MappedFloats(const Device& device, const cl::Buffer& buffer, size_t count)
    : device_(device), buffer_(buffer) {
    data_ = static_cast<float*>(checked(device_.body(), "mapping a strip", [&] {
        return device_.body().queue.enqueueMapBuffer(buffer_, CL_TRUE, CL_MAP_READ, 0, count * sizeof(float));
    }));
}

MappedFloats::~MappedFloats() {
    try {
        device_.body().queue.enqueueUnmapMemObject(buffer_, data_);
    } catch (const cl::Error&) {
        return;  // the next call on the queue says what is wrong
    }
}

}  // namespace spectrad
