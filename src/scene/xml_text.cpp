#include "scene/xml_text.h"

#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <vector>

namespace spectrad {

namespace {

bool isCharacter(unsigned long code) {
    return code == '\t' || code == '\n' || code == '\r' || (code >= 0x20 && code <= 0xD7FF) ||
           (code >= 0xE000 && code <= 0xFFFD) || (code >= 0x10000 && code <= 0x10FFFF);
}

/// `reference` is what stands between & and ;.
bool isAllowedReference(std::string_view reference) {
    if (startsWith(reference, "#")) {
        const bool hexadecimal = startsWith(reference, "#x");
        const std::string_view digits = reference.substr(hexadecimal ? 2 : 1);
        unsigned long code = 0;
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), code, hexadecimal ? 16 : 10);
        return error == std::errc() && end == digits.data() + digits.size() && isCharacter(code);
    }
    return reference == "lt" || reference == "gt" || reference == "amp" || reference == "quot" ||
           reference == "apos";
}

/// End of the comment, CDATA section or processing instruction that begins at `at`; `at` itself if none
/// begins there. What stands in it is not looked at.
size_t endOfOpaque(std::string_view text, size_t at) {
    static constexpr std::pair<std::string_view, std::string_view> opaque[] = {
        {"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}};
    for (const auto& [open, close] : opaque) {
        if (!startsWith(text.substr(at), open)) continue;
        const size_t end = text.find(close, at + open.size());
        return end == std::string_view::npos ? text.size() : end + close.size();
    }
    return at;
}

/// The encoding that an XML declaration at the beginning names; empty if it names none.
std::string_view declaredEncoding(std::string_view text) {
    if (!startsWith(text, "<?xml")) return {};
    text = text.substr(0, text.find("?>"));
    const size_t key = text.find("encoding");
    if (key == std::string_view::npos) return {};
    const size_t open = text.find_first_of("\"'", key);
    if (open == std::string_view::npos) return {};
    const size_t close = text.find(text[open], open + 1);
    return close == std::string_view::npos ? std::string_view() : text.substr(open + 1, close - open - 1);
}

bool isUtf8Name(std::string_view encoding) {
    const std::string lower = lowerCase(encoding);
    return lower == "utf-8" || lower == "utf8" || lower == "us-ascii" || lower == "ascii";
}

std::optional<XmlComplaint> complaintAboutBytes(std::string_view text) {
    for (size_t at = 0; at < text.size();) {
        const unsigned char byte = static_cast<unsigned char>(text[at]);
        if (byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r')
            return XmlComplaint{
                at, fmt::format("control character 0x{:02x} (is this an XML file in UTF-8?)", byte)};
        const size_t bytes = utf8Length(text, at);
        if (bytes == 0) return XmlComplaint{at, fmt::format("byte 0x{:02x} is not UTF-8", byte)};
        at += bytes;
    }
    return std::nullopt;
}

}  // namespace

std::optional<XmlComplaint> complaintAbout(std::string_view text) {
    if (startsWith(text, "\xFE\xFF") || startsWith(text, "\xFF\xFE"))
        return XmlComplaint{0, "the file is UTF-16 (allowed: UTF-8)"};
    if (auto complaint = complaintAboutBytes(text)) return complaint;
    if (const std::string_view encoding = declaredEncoding(text); !encoding.empty() && !isUtf8Name(encoding))
        return XmlComplaint{0, fmt::format("encoding '{}' (allowed: UTF-8)", encoding)};
    for (size_t at = text.find_first_of("<&"); at != std::string_view::npos;
         at = text.find_first_of("<&", at)) {
        if (text[at] == '<') {
            const size_t end = endOfOpaque(text, at);
            if (end == at && startsWith(text.substr(at), "<!"))
                return XmlComplaint{at, "DOCTYPE and other declarations are not allowed in a scene"};
            at = std::max(end, at + 1);
            continue;
        }
        const size_t end = text.find(';', at);
        const std::string_view reference = end == std::string_view::npos
                                               ? text.substr(at + 1, 12)
                                               : text.substr(at + 1, std::min<size_t>(end - at - 1, 40));
        if (end == std::string_view::npos || !isAllowedReference(reference)) {
            const std::string_view name = reference.substr(0, reference.find_first_of(" \t\r\n\"'<"));
            return XmlComplaint{
                at, fmt::format(
                        "entity '&{}{}' (allowed: &lt; &gt; &amp; &quot; &apos; and character numbers; "
                        "a bare & is written &amp;)",
                        name, name.size() == reference.size() && end != std::string_view::npos ? ";" : "")};
        }
        at = end;
    }
    return std::nullopt;
}

std::optional<XmlComplaint> unmatchedTag(std::string_view text) {
    struct Open {
        size_t offset;
        std::string_view name;
    };
    std::vector<Open> open;
    for (size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at)) {
        if (const size_t end = endOfOpaque(text, at); end != at) {
            at = end;
            continue;
        }
        const bool closes = startsWith(text.substr(at), "</");
        const std::string_view rest = text.substr(at + (closes ? 2 : 1));
        const std::string_view name = rest.substr(0, rest.find_first_of(" \t\r\n/>"));
        size_t end = at;
        for (char quote = 0; end < text.size() && (quote != 0 || text[end] != '>'); ++end) {
            if (quote == 0 && (text[end] == '"' || text[end] == '\'')) {
                quote = text[end];
            } else if (text[end] == quote) {
                quote = 0;
            }
        }
        if (closes) {
            if (open.empty()) return XmlComplaint{at, fmt::format("end tag </{}> without a start tag", name)};
            if (open.back().name != name)
                return XmlComplaint{at,
                                    fmt::format("end tag </{}> where <{}> is open", name, open.back().name)};
            open.pop_back();
        } else if (end == text.size() || text[end - 1] != '/') {
            open.push_back({at, name});
        }
        at = std::max(end, at + 1);
    }
    if (open.empty()) return std::nullopt;
    return XmlComplaint{open.back().offset, fmt::format("<{}> is never closed", open.back().name)};
}

std::string_view rootElementName(std::string_view text) {
    if (startsWith(text, "\xEF\xBB\xBF")) text.remove_prefix(3);
    size_t at = 0;
    while (true) {
        at = text.find_first_not_of(" \t\r\n", at);
        if (at == std::string_view::npos || text[at] != '<') return {};
        size_t end = endOfOpaque(text, at);
        if (end == at && startsWith(text.substr(at), "<!")) {
            end = text.find('>', at);
            end = end == std::string_view::npos ? text.size() : end + 1;
        }
        if (end == at) break;
        at = end;
    }
    const std::string_view rest = text.substr(at + 1);
    return rest.substr(0, rest.find_first_of(" \t\r\n/>"));
}

}  // namespace spectrad
