// Writes EXR files of the bispectral part of the spectral layout 1.0, by OpenEXR alone.
#pragma once

#include "image/bispectral.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace spectrad::test {

/// "T.400,000000nm.450,000000nm", or with one wavelength where both are the same.
inline std::string bispectralName(double inNm, double outNm) {
    std::string name =
        inNm == outNm ? fmt::format("T.{:.6f}nm", inNm) : fmt::format("T.{:.6f}nm.{:.6f}nm", inNm, outNm);
    bool layer = true;  // the dot behind T and between the waves stays a dot
    for (size_t i = 1; i < name.size(); ++i) {
        if (name[i] != '.') continue;
        layer = name[i - 1] == 'T' || name[i - 1] == 'm';
        if (!layer) name[i] = ',';
    }
    return name;
}

/// Every cell as a channel, in an image of width × 1 pixels whose values differ by ±`spread` about the
/// cell's.
inline void writeBispectral(const std::filesystem::path& path, const std::vector<BispectralCell>& cells,
                            int width = 1, float spread = 0) {
    Imf::Header header(width, 1);
    header.insert("spectralLayoutVersion", Imf::StringAttribute("1.0"));
    Imf::FrameBuffer frame;
    std::vector<std::vector<float>> rows;
    rows.reserve(cells.size());
    for (const BispectralCell& cell : cells) {
        const std::string name = bispectralName(cell.inNm, cell.outNm);
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        std::vector<float> row(static_cast<size_t>(width), static_cast<float>(cell.value));
        for (size_t x = 0; x + 1 < row.size(); x += 2)
            row[x] += spread, row[x + 1] -= spread;
        rows.push_back(std::move(row));
        frame.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(rows.back().data()), sizeof(float),
                                      sizeof(float) * static_cast<size_t>(width)));
    }
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(1);
}

}  // namespace spectrad::test
