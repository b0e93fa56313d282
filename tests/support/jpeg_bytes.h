// Files as libjpeg writes them at its best.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <jpeglib.h>
#include <string>
#include <vector>

namespace spectrad::test {

/// `value(x, y, channel)`, 0…255; 1 channel grey, 3 RGB, 4 CMYK. An ICC profile in parts of `partSize` bytes.
inline std::string jpegOf(int width, int height, int channels, const std::function<int(int, int, int)>& value,
                          const std::string& profile = {}, size_t partSize = 65000) {
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &bytes, &size);
    jpeg.image_width = static_cast<JDIMENSION>(width);
    jpeg.image_height = static_cast<JDIMENSION>(height);
    jpeg.input_components = channels;
    jpeg.in_color_space = channels == 1 ? JCS_GRAYSCALE : channels == 3 ? JCS_RGB : JCS_CMYK;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 100, TRUE);
    for (int i = 0; i < jpeg.num_components; ++i)  // colours as fine as brightness
        jpeg.comp_info[i].h_samp_factor = jpeg.comp_info[i].v_samp_factor = 1;
    jpeg_start_compress(&jpeg, TRUE);
    const size_t parts = (profile.size() + partSize - 1) / partSize;
    for (size_t i = 0; i < parts; ++i) {
        const std::string marker = std::string("ICC_PROFILE\0", 12) + static_cast<char>(i + 1) +
                                   static_cast<char>(parts) + profile.substr(i * partSize, partSize);
        jpeg_write_marker(&jpeg, JPEG_APP0 + 2, reinterpret_cast<const JOCTET*>(marker.data()),
                          static_cast<unsigned>(marker.size()));
    }
    std::vector<JSAMPLE> row(static_cast<size_t>(width * channels));
    for (int y = 0; y < height; ++y) {
        for (int i = 0; i < width * channels; ++i)
            row[static_cast<size_t>(i)] = static_cast<JSAMPLE>(value(i / channels, y, i % channels));
        JSAMPROW rows = row.data();
        jpeg_write_scanlines(&jpeg, &rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    std::string text(reinterpret_cast<const char*>(bytes), size);
    jpeg_destroy_compress(&jpeg);
    std::free(bytes);
    return text;
}

}  // namespace spectrad::test
