// How libpng tells of its errors: it calls back and then leaves its C code by longjmp.
#pragma once

#include <png.h>

#include <string>

namespace spectrad {

/// What libpng's error pointer is to point at.
struct PngErrors {
    std::string error;          ///< the last one's message
    std::string colourWarning;  ///< the first of a chunk that says what colours are (libpng then drops it)
};

/// Keeps the message in PngErrors and jumps back to where png_jmpbuf() was set.
[[noreturn]] void keepPngError(png_structp png, png_const_charp message);
void keepPngWarning(png_structp png, png_const_charp message);

}  // namespace spectrad
