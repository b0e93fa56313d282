#include "viewer/cube_subject.h"

#include "base/stopped.h"
#include "colour/develop.h"
#include "image/envi_read.h"
#include "render/cube_light.h"

#include <algorithm>
#include <cmath>

namespace spectrad::view {

/// A row of a cube that is too large to be held, read by the meter's own reader.
struct CubeSubject::MeterRow {
    std::unique_ptr<CubeReader> reader;
    std::vector<float> values;
    int y = -1;
};

class CubeSubject::CubeStill : public Still {
  public:
    CubeStill(std::shared_ptr<const Eye> eye, DetectorWeights weights, CubeInfo info,
              std::shared_ptr<const std::vector<float>> whole, std::shared_ptr<MeterRow> row)
        : Still(std::move(eye)),
          weights_(std::move(weights)),
          info_(std::move(info)),
          whole_(std::move(whole)),
          row_(std::move(row)) {}

    [[nodiscard]] std::vector<double> spectrumAt(int x, int y) override {
        if (x < 0 || y < 0 || x >= info_.width || y >= info_.height) return {};
        const size_t across = static_cast<size_t>(info_.width), count = info_.wavelengths.size();
        const float* bands = whole_ ? whole_->data() + static_cast<size_t>(y) * count * across : row(y);
        std::vector<double> spectrum;
        for (size_t band = 0; band < count; ++band)
            spectrum.push_back(static_cast<double>(bands[band * across + static_cast<size_t>(x)]));
        return spectrum;
    }
    [[nodiscard]] DetectorWeights weights() const override { return weights_; }

  private:
    [[nodiscard]] const float* row(int y) {
        if (row_->y != y) {
            row_->y = -1;
            row_->values.resize(info_.wavelengths.size() * static_cast<size_t>(info_.width));
            row_->reader->read(y, 1, row_->values.data());
            row_->y = y;
        }
        return row_->values.data();
    }

    DetectorWeights weights_;
    CubeInfo info_;
    std::shared_ptr<const std::vector<float>> whole_;
    std::shared_ptr<MeterRow> row_;
};

namespace {

constexpr const char* daylight = "illuminants/D65";
/// Of a strip: enough for the blocks of 32 rows that PIZ compresses together.
constexpr size_t stripBytes = size_t{128} << 20;
constexpr int blockRows = 32;

double timesOf(const Look& look) {
    return look.lights.empty() ? 1 : look.lights.front().on ? look.lights.front().times : 0;
}

}  // namespace

CubeSubject::CubeSubject(const std::filesystem::path& file, const Library& library, Notes& notes,
                         size_t mostHeld)
    : file_(file),
      standard_(standardEye(library)),
      reader_(openCube(file, notes)),
      resolver_(library, file.parent_path(), false, unsaid_),
      held_(std::make_shared<std::vector<float>>()) {
    const size_t rowBytes = sizeof(float) * wavelengths().size() * static_cast<size_t>(width());
    const auto rowsIn = [&](size_t bytes) {
        return static_cast<int>(std::clamp<size_t>(bytes / rowBytes, 1, static_cast<size_t>(height())));
    };
    stripRows_ = rowsIn(mostHeld);
    if (stripRows_ < height()) {
        stripRows_ = rowsIn(std::min(mostHeld, stripBytes));
        if (stripRows_ > blockRows) stripRows_ -= stripRows_ % blockRows;
        meter_ = std::make_shared<MeterRow>();
        meter_->reader = openCube(file, unsaid_);
    }
    first_.eye = std::make_shared<const Eye>(standard_);
    if (lit()) {
        LightSetting light;
        light.name = "light";
        light.emitter.spectrum = resolver_.resolve(daylight, Role::light, {});
        first_.lights.push_back(std::move(light));
    }
}

CubeSubject::~CubeSubject() = default;

bool CubeSubject::lit() const {
    return needsLight(info().kind);
}

std::vector<std::filesystem::path> CubeSubject::files() const {
    std::vector<std::filesystem::path> all{file_};
    if (const auto header = findEnviHeader(file_); header && *header != file_) all.push_back(*header);
    return all;
}

const float* CubeSubject::row(int y) {
    if (y < heldFrom_ || y >= heldTo_) {
        const int from = y - y % stripRows_, rows = std::min(stripRows_, height() - from);
        throwIfStopped(stop());
        heldFrom_ = heldTo_ = 0;
        held_->resize(static_cast<size_t>(rows) * wavelengths().size() * static_cast<size_t>(width()));
        reader_->read(from, rows, held_->data());
        heldFrom_ = from;
        heldTo_ = from + rows;
    }
    return held_->data() +
           static_cast<size_t>(y - heldFrom_) * wavelengths().size() * static_cast<size_t>(width());
}

DetectorWeights CubeSubject::weights(const Look& look) const {
    const Detector& detector = look.eye->detector;
    DetectorWeights made =
        weightsOn(wavelengths(),
                  lit() ? litBy(look.lights.at(0).emitter.spectrum, detector, standard_.detector) : detector);
    if (lit())
        for (std::vector<double>& weight : made.weights)
            for (double& w : weight)
                w *= timesOf(look);
    return made;
}

const ChannelImage& CubeSubject::projected(const Look& look) {
    const std::string light = lit() ? look.lights.at(0).emitter.spectrum.text : std::string();
    const auto known = std::find_if(projections_.begin(), projections_.end(), [&](const Projection& p) {
        return p.light == light && p.eye == look.eye;
    });
    if (known != projections_.end()) return known->xyz;
    Look whole = look;
    for (LightSetting& setting : whole.lights) {
        setting.times = 1;
        setting.on = true;
    }
    const DetectorWeights detector = weights(whole);
    ChannelImage channels(width(), height(), detector.weights.size());
    for (int y = 0; y < height(); ++y)
        observeRow(detector, row(y), y, channels);
    constexpr size_t kept = 2;
    if (projections_.size() >= kept) projections_.erase(projections_.begin());
    projections_.push_back(
        {light, look.eye,
         look.eye->detector.tristimulus ? std::move(channels) : toXyz(look.eye->matrix, channels)});
    return projections_.back().xyz;
}

ChannelImage CubeSubject::xyz(const Look& look) {
    ChannelImage image = projected(look);
    if (const double times = timesOf(look); times != 1)
        for (std::vector<double>& plane : image.plane)
            for (double& value : plane)
                value *= times;
    return image;
}

void CubeSubject::show(const Look& look, const Shown& shown, Codes& codes) {
    Shown scaled = shown;
    const double times = timesOf(look);
    scaled.toSignals = scaled.toSignals * diagonal({times, times, times});
    encodeCodes(projected(look), scaled, codes);
}

void CubeSubject::showMixed(const Look& a, const Look& b, double mix, const Shown& shown, Codes& codes) {
    ChannelImage mixed = xyz(a);
    const ChannelImage& other = projected(b);
    const double times = timesOf(b);
    for (size_t c = 0; c < 3; ++c)
        for (size_t i = 0; i < mixed.pixels(); ++i)
            mixed.plane[c][i] = std::lerp(mixed.plane[c][i], times * other.plane[c][i], mix);
    encodeCodes(mixed, shown, codes);
}

std::shared_ptr<Still> CubeSubject::still(const Look& look) {
    if (!meter_) (void)row(0);  // all rows are held then
    return std::make_shared<CubeStill>(look.eye, weights(look), info(), meter_ ? nullptr : held_, meter_);
}

White CubeSubject::white(const Look& look) {
    const Detector& detector = look.eye->detector;
    if (!lit())
        return statedWhite(info(), detector, look.eye->matrix, standard_.detector, resolver_, unsaid_);
    const Spectrum& light = look.lights.at(0).emitter.spectrum;
    return withLuminance(whiteOf(light.text, light.curve(), detector, look.eye->matrix, {}), diffuserY);
}

double CubeSubject::whiteAmount(const Look& look) {
    if (lit()) (void)litBy(look.lights.at(0).emitter.spectrum, look.eye->detector, standard_.detector);
    return timesOf(look);
}

const CubeSubject::Plane& CubeSubject::plane(size_t band) {
    const auto known =
        std::find_if(planes_.begin(), planes_.end(), [&](const Plane& p) { return p.band == band; });
    if (known != planes_.end()) return *known;
    Plane made{band, {}, 0};
    const size_t across = static_cast<size_t>(width());
    made.values.reserve(across * static_cast<size_t>(height()));
    for (int y = 0; y < height(); ++y) {
        const float* values = row(y) + band * across;
        made.values.insert(made.values.end(), values, values + across);
    }
    std::vector<double> sorted(made.values.begin(), made.values.end());
    made.top = quantile(sorted, exposedQuantile);
    if (!(made.top > 0)) made.top = *std::max_element(sorted.begin(), sorted.end());
    constexpr size_t kept = 3;
    if (planes_.size() >= kept) planes_.erase(planes_.begin());
    planes_.push_back(std::move(made));
    return planes_.back();
}

void CubeSubject::showBands(BandPicture& picture, Codes& codes) {
    const Encoder8 encoder(picture.display);
    codes.assign(static_cast<size_t>(width()) * static_cast<size_t>(height()), 0xff000000u);
    for (size_t c = 0; c < 3; ++c) {
        const Plane& source = plane(std::min(picture.bands[c], wavelengths().size() - 1));
        const double top = lit() || !(source.top > 0) ? 1 : source.top;
        picture.white[c] = top * std::exp2(-picture.ev);
        for (size_t i = 0; i < codes.size(); ++i) {
            const double signal = static_cast<double>(source.values[i]) / picture.white[c];
            codes[i] |= std::uint32_t{encoder(signal)} << (8 * c);
            if (signal < -signalTolerance || signal > 1 + signalTolerance) codes[i] &= 0xfeffffffu;
        }
    }
}

}  // namespace spectrad::view
