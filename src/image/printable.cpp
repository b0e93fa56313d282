#include "image/printable.h"

namespace spectrad {

std::string printable(std::string_view text) {
    constexpr size_t longest = 60;
    size_t end = text.size();
    if (end > longest) {
        end = longest;
        while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80)
            --end;  // not within a UTF-8 character
    }
    std::string line(text.substr(0, end));
    for (char& c : line)
        if (static_cast<unsigned char>(c) < ' ' || c == 0x7f) c = '?';
    return end < text.size() ? line + "…" : line;
}

}  // namespace spectrad
