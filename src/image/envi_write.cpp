#include "base/files.h"
#include "base/text.h"
#include "image/cube_check.h"
#include "image/envi_header.h"
#include "image/exr_layout.h"
#include "image/file_sink.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <system_error>

namespace spectrad {

namespace fs = std::filesystem;

namespace envi {

namespace {

/// "key = {a, b, c}", broken well before the 10 000 characters of a line that GDAL reads.
std::string listField(std::string_view key, const std::vector<std::string>& items) {
    constexpr size_t longestLine = 1000;
    std::string text = fmt::format("{} = {{", key);
    size_t lineStart = 0;
    for (size_t i = 0; i < items.size(); ++i) {
        if (i > 0) text += ", ";
        if (text.size() - lineStart + items[i].size() > longestLine) {
            text += '\n';
            lineStart = text.size();
        }
        text += items[i];
    }
    return text + "}\n";
}

/// Full width at half maximum of a band, nm. A point band has none; as readers want one, it gets what it
/// stands for: the range half-way to its neighbours.
double fullWidth(const Wavelengths& grid, size_t j) {
    Wavelengths shape = grid;
    if (grid.projection == Projection::point) shape.projection = Projection::box;
    const Band b = band(shape, j);
    return shape.projection == Projection::slit ? (b.to - b.from) / 2 : b.to - b.from;
}

size_t nearestBand(const Wavelengths& grid, double nm) {
    const auto closer = [&](double a, double b) { return std::abs(a - nm) < std::abs(b - nm); };
    return static_cast<size_t>(std::min_element(grid.nm.begin(), grid.nm.end(), closer) - grid.nm.begin());
}

std::string_view dataUnits(CubeKind kind) {
    switch (kind) {
        case CubeKind::radiance:
            return "W/(m^2 sr nm)";
        case CubeKind::irradiance:
            return "W/(m^2 nm)";
        case CubeKind::reflectance:
        case CubeKind::transmittance:
            break;
    }
    return "unitless";
}

}  // namespace

std::string headerText(const CubeInfo& info, const fs::path& file) {
    const Wavelengths& grid = info.wavelengths;
    const size_t bands = grid.size();
    std::string text = "ENVI\n";
    text += fmt::format("description = {{Spectral {}, {}}}\n", name(info.kind), dataUnits(info.kind));
    text += fmt::format("samples = {}\nlines = {}\nbands = {}\n", info.width, info.height, bands);
    text += "header offset = 0\nfile type = ENVI Standard\ndata type = 4\ninterleave = bil\n";
    text += fmt::format("byte order = {}\n", std::endian::native == std::endian::little ? 0 : 1);
    if (bands >= 3)  // bands that look red, green and blue, counted from 1
        text += fmt::format("default bands = {{{}, {}, {}}}\n", nearestBand(grid, 640) + 1,
                            nearestBand(grid, 550) + 1, nearestBand(grid, 460) + 1);
    std::vector<std::string> names, wavelengths, widths;
    for (size_t j = 0; j < bands; ++j) {
        wavelengths.push_back(shortest(grid.nm[j]));
        names.push_back(wavelengths.back() + " nm");
        widths.push_back(shortest(fullWidth(grid, j)));
    }
    text += listField("band names", names);
    text += "wavelength units = Nanometers\n";
    text += listField("wavelength", wavelengths);
    text += listField("fwhm", widths);
    text += fmt::format("data units = {}\n", dataUnits(info.kind));
    text += fmt::format("{0}quantity = {1}\n{0}projection = {2}\n{0}step = {3}\n", ourPrefix, name(info.kind),
                        name(grid.projection), shortest(grid.step));
    for (const auto& [key, value] : info.attributes) {
        if (key.empty() || key == exr::quantity || key == exr::projection || key == exr::step)
            throw InputError({file.string()}, "attribute '" + key + "' is the file's own");
        text += fmt::format("{}{} = {{{}}}\n", ourPrefix, encoded(key), encoded(value));
    }
    return text;
}

}  // namespace envi

namespace {

fs::path dataPath(const fs::path& target) {
    return extensionOf(target) == ".hdr" ? fs::path(target).replace_extension(".img") : target;
}

class EnviWriter : public CubeWriter {
  public:
    EnviWriter(const fs::path& target, const CubeInfo& info)
        : info_(info),
          data_(dataPath(target)),
          header_(fs::path(data_.target()).replace_extension(".hdr")),
          sink_(data_.path(), data_.target()) {
        const std::string text = envi::headerText(info, header_.target());
        FileSink header(header_.path(), header_.target());
        header.write(text.data(), text.size());
        header.close();
    }

    void write(int rows, const float* bands, const float* /*previewRgb*/) override {
        if (rows < 0 || rows > info_.height - written_)
            throw std::logic_error("more rows than the image has");
        checkFinite(info_, written_, rows, bands, data_.target());
        const size_t row = info_.wavelengths.size() * static_cast<size_t>(info_.width);
        sink_.write(bands, static_cast<size_t>(rows) * row * sizeof(float));
        written_ += rows;
    }

    WriteReport finish() override {
        if (written_ != info_.height) throw std::logic_error("finished before the last row");
        sink_.close();
        commitBoth();
        return {};
    }

  private:
    /// Both files appear or neither: what stood at the data's place is kept under another name until the
    /// header is there.
    void commitBoth() {
        const PendingFile former(data_.target());
        std::error_code none;
        fs::remove(former.path(), none);
        fs::create_hard_link(data_.target(), former.path(), none);
        const bool kept = !none;
        data_.commit();
        try {
            header_.commit();
        } catch (const MachineError&) {
            if (kept)
                fs::rename(former.path(), data_.target(), none);
            else
                fs::remove(data_.target(), none);
            throw;
        }
    }

    CubeInfo info_;
    PendingFile data_, header_;
    FileSink sink_;
    int written_ = 0;  ///< rows
};

}  // namespace

std::unique_ptr<CubeWriter> createEnvi(const fs::path& target, const CubeInfo& info) {
    checkCubeInfo(info, target);
    return std::make_unique<EnviWriter>(target, info);
}

}  // namespace spectrad
