// What OpenEXR throws at damaged files, as one line.
#pragma once

#include "base/error.h"

#include <algorithm>
#include <filesystem>
#include <new>
#include <string>

namespace spectrad {

/// Calls read(); anything but our own errors becomes an InputError that names the file.
template <typename Read>
auto readingExr(const std::filesystem::path& path, Read read) {
    try {
        return read();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw InputError({path.string()}, "damaged, or more than the memory of this machine holds");
    } catch (const std::exception& error) {
        std::string words = error.what();
        std::replace_if(
            words.begin(), words.end(), [](unsigned char c) { return c < ' '; }, ' ');
        throw InputError({path.string()}, "cannot be read as EXR: " + words);
    }
}

}  // namespace spectrad
