#include "scene/scene_text.h"

#include "base/text.h"
#include "scene/set_overrides.h"

#include <algorithm>
#include <vector>

namespace spectrad {

namespace {

constexpr std::string_view mark = "\xEF\xBB\xBF";  // of byte order, which offsets do not count

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

struct AttributeText {
    std::string_view name;
    size_t from = 0;                    ///< of the blanks before it
    size_t valueFrom = 0, valueTo = 0;  ///< between the quotes
};

/// The attributes of a start tag, whose name begins at `at`. The text is well-formed: pugixml has read it.
std::vector<AttributeText> attributesAt(std::string_view text, size_t at, size_t& end) {
    const auto skip = [&](auto while_) {
        while (at < text.size() && while_(text[at]))
            ++at;
    };
    skip([](char c) { return !isBlank(c) && c != '>' && c != '/'; });
    end = at;
    std::vector<AttributeText> found;
    for (;;) {
        AttributeText attribute;
        attribute.from = at;
        skip(isBlank);
        if (at >= text.size() || text[at] == '>' || text[at] == '/') return found;
        const size_t name = at;
        skip([](char c) { return !isBlank(c) && c != '='; });
        attribute.name = text.substr(name, at - name);
        skip([](char c) { return c != '"' && c != '\''; });
        const char quote = text[at++];
        attribute.valueFrom = at;
        skip([quote](char c) { return c != quote; });
        attribute.valueTo = at++;
        end = at;
        found.push_back(attribute);
    }
}

std::string escaped(std::string_view value) {
    std::string out;
    for (const char c : value) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&apos;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

/// The element after `node` in the document's order, without recursion.
pugi::xml_node following(pugi::xml_node node) {
    if (node.first_child()) return node.first_child();
    while (node && !node.next_sibling())
        node = node.parent();
    return node.next_sibling();
}

struct Replacement {
    size_t from = 0, to = 0;
    std::string by;
};

void compare(std::string_view text, size_t begin, pugi::xml_node was, pugi::xml_node is,
             std::vector<Replacement>& edits) {
    const bool same = std::equal(was.attributes_begin(), was.attributes_end(), is.attributes_begin(),
                                 is.attributes_end(), [](const auto& a, const auto& b) {
                                     return std::string_view(a.name()) == b.name() &&
                                            std::string_view(a.value()) == b.value();
                                 });
    if (same) return;
    size_t end = 0;
    const std::vector<AttributeText> there =
        attributesAt(text, begin + static_cast<size_t>(was.offset_debug()), end);
    for (const AttributeText& attribute : there) {
        const std::string name(attribute.name);
        const pugi::xml_attribute now = is.attribute(name.c_str());
        if (!now)
            edits.push_back({attribute.from, attribute.valueTo + 1, ""});
        else if (std::string_view(now.value()) != was.attribute(name.c_str()).value())
            edits.push_back({attribute.valueFrom, attribute.valueTo, escaped(now.value())});
    }
    for (const pugi::xml_attribute attribute : is.attributes())
        if (!was.attribute(attribute.name()))
            edits.push_back(
                {end, end, std::string(" ") + attribute.name() + "=\"" + escaped(attribute.value()) + "\""});
}

}  // namespace

SceneText::SceneText(std::string bytes, std::string file)
    : bytes_(std::move(bytes)), file_(std::move(file)), original_(bytes_, file_), changed_(bytes_, file_) {}

void SceneText::apply(std::span<const std::string> options) {
    applyOverrides(changed_, options);
}

pugi::xml_node SceneText::elementAt(const SourceLocation& place) const {
    for (pugi::xml_node node = changed_.root(); node; node = following(node)) {
        if (node.type() != pugi::node_element) continue;
        const SourceLocation where = changed_.where(node);
        if (where.line == place.line && where.column == place.column) return node;
    }
    throw InputError(place, "is no element of '" + file_ + "': it cannot be changed there");
}

void SceneText::set(const SourceLocation& place, const std::string& child, const std::string& attribute,
                    const std::string& value) {
    pugi::xml_node node = elementAt(place);
    if (!child.empty()) node = node.child(child.c_str());
    if (!node) throw InputError(place, "has no <" + child + "> to change");
    changed_.setAttribute(node, attribute, value, attribute);
}

std::string SceneText::get(const SourceLocation& place, const std::string& attribute) const {
    return elementAt(place).attribute(attribute.c_str()).value();
}

void SceneText::append(const std::string& element) {
    appended_ += element;
}

std::string SceneText::text() const {
    const size_t begin = startsWith(bytes_, mark) ? mark.size() : 0;
    std::vector<Replacement> edits;
    pugi::xml_node is = changed_.root();
    for (pugi::xml_node was = original_.root(); was && is; was = following(was), is = following(is))
        if (was.type() == pugi::node_element) compare(bytes_, begin, was, is, edits);
    if (!appended_.empty()) {
        const size_t end = bytes_.rfind("</");  // of the root
        if (end == std::string::npos)
            throw InputError({file_}, "is a scene without content: there is no place for what was added");
        edits.push_back({end, end, "  " + appended_ + "\n"});
    }
    std::string out;
    size_t at = 0;
    for (const Replacement& edit : edits) {
        out += bytes_.substr(at, edit.from - at);
        out += edit.by;
        at = edit.to;
    }
    return out + bytes_.substr(at);
}

}  // namespace spectrad
