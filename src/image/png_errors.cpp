#include "image/png_errors.h"

#include <string_view>

namespace spectrad {

void keepPngError(png_structp png, png_const_charp message) {
    static_cast<PngErrors*>(png_get_error_ptr(png))->error = message;
    png_longjmp(png, 1);
}

void keepPngWarning(png_structp png, png_const_charp message) {
    std::string& kept = static_cast<PngErrors*>(png_get_error_ptr(png))->colourWarning;
    for (const char* chunk : {"iCCP", "cHRM", "gAMA", "sRGB"})
        if (kept.empty() && std::string_view(message).starts_with(chunk)) kept = message;
}

}  // namespace spectrad
