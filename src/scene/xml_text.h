// What a scene's bytes must be before a parser sees them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace spectrad {

struct XmlComplaint {
    size_t offset;
    std::string message;
};

/// The first thing in `text` that a scene may not contain: bytes that are not UTF-8 or are control
/// characters, a document type declaration, a reference to an entity beyond lt, gt, amp, quot, apos, or to a
/// character that is none, an encoding other than UTF-8. Nothing if all is well; whether the tags match is
/// the parser's to say.
[[nodiscard]] std::optional<XmlComplaint> complaintAbout(std::string_view text);

/// In a text whose tags do not match: the start tag left open, or the end tag that closes another element.
/// Nothing if all match.
[[nodiscard]] std::optional<XmlComplaint> unmatchedTag(std::string_view text);

/// Name of the first element behind comments and declarations; empty if the text does not begin like XML.
[[nodiscard]] std::string_view rootElementName(std::string_view text);

}  // namespace spectrad
