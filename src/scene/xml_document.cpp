#include "scene/xml_document.h"

#include "base/text.h"
#include "scene/xml_text.h"

#include <algorithm>

namespace spectrad {

namespace {

std::string wellFormednessMessage(pugi::xml_parse_status status) {
    switch (status) {
        case pugi::status_no_document_element:
            return "no element in the file";
        case pugi::status_bad_attribute:
            return "not well-formed: malformed attribute (expected name=\"value\")";
        case pugi::status_bad_start_element:
            return "not well-formed: malformed start tag";
        case pugi::status_bad_end_element:
            return "not well-formed: malformed end tag";
        case pugi::status_bad_comment:
            return "not well-formed: comment without end";
        case pugi::status_bad_cdata:
            return "not well-formed: CDATA section without end";
        case pugi::status_bad_pi:
            return "not well-formed: malformed or unended declaration";
        case pugi::status_unrecognized_tag:
            return "not well-formed: '<' that begins no tag (write &lt; for the character)";
        case pugi::status_out_of_memory:
            return "not enough memory for this file";
        default:
            return "not well-formed XML";
    }
}

}  // namespace

XmlDocument::XmlDocument(std::string_view bytes, std::string file) : file_(std::move(file)) {
    if (startsWith(bytes, "\xEF\xBB\xBF")) bytes.remove_prefix(3);
    lineStart_.push_back(0);
    for (size_t i = 0; i < bytes.size(); ++i) {
        const bool ends =
            bytes[i] == '\n' || (bytes[i] == '\r' && (i + 1 == bytes.size() || bytes[i + 1] != '\n'));
        if (ends) lineStart_.push_back(i + 1);
    }
    if (const auto complaint = complaintAbout(bytes))
        throw InputError(at(complaint->offset), complaint->message);
    parse(bytes);
}

void XmlDocument::parse(std::string_view text) {
    const pugi::xml_parse_result result = document_.load_buffer(
        text.data(), text.size(), pugi::parse_default | pugi::parse_fragment, pugi::encoding_utf8);
    if (result.status == pugi::status_end_element_mismatch || result.status == pugi::status_bad_end_element) {
        if (const auto complaint = unmatchedTag(text))
            throw InputError(at(complaint->offset), "not well-formed: " + complaint->message);
    }
    if (!result)
        throw InputError(at(static_cast<size_t>(std::max<ptrdiff_t>(result.offset, 0))),
                         wellFormednessMessage(result.status));
    // Kept by parse_fragment only to be refused.
    for (pugi::xml_node node = document_.first_child(); node; node = node.next_sibling())
        if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata)
            throw InputError(at(static_cast<size_t>(std::max<ptrdiff_t>(node.offset_debug(), 0))),
                             "not well-formed: text outside of the root element");
    if (!document_.document_element())
        throw InputError(at(0), wellFormednessMessage(pugi::status_no_document_element));
    for (pugi::xml_node node = root().next_sibling(); node; node = node.next_sibling())
        if (node.type() == pugi::node_element)
            throw InputError(where(node),
                             std::string("second root element <") + node.name() + "> (a file has one)");
}

SourceLocation XmlDocument::at(size_t offset) const {
    const auto line = std::upper_bound(lineStart_.begin(), lineStart_.end(), offset) - 1;
    return {file_, static_cast<int>(line - lineStart_.begin()) + 1, static_cast<int>(offset - *line) + 1};
}

SourceLocation XmlDocument::where(pugi::xml_node node) const {
    const ptrdiff_t offset = node.offset_debug();
    if (offset < 0) return {file_, 0, 0};
    // An element's offset is that of its name.
    return at(static_cast<size_t>(offset) - (node.type() == pugi::node_element && offset > 0 ? 1 : 0));
}

SourceLocation XmlDocument::where(pugi::xml_node node, pugi::xml_attribute attribute) const {
    for (const auto& [overridden, option] : overrides_)
        if (overridden == attribute) return {option, 0, 0};
    return where(node);
}

void XmlDocument::setAttribute(pugi::xml_node node, const std::string& attribute, const std::string& value,
                               std::string option) {
    if (value.empty()) {
        node.remove_attribute(attribute.c_str());
        return;
    }
    pugi::xml_attribute target = node.attribute(attribute.c_str());
    if (!target) target = node.append_attribute(attribute.c_str());
    target.set_value(value.c_str());
    std::erase_if(overrides_, [&](const auto& entry) { return entry.first == target; });
    overrides_.emplace_back(target, std::move(option));
}

}  // namespace spectrad
