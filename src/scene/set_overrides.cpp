#include "scene/set_overrides.h"

#include "base/text.h"
#include "scene/grammar.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace spectrad {

namespace {

constexpr std::array<std::string_view, 7> kinds{"spectrum", "material", "node", "light",
                                                "camera",   "detector", "pass"};
/// Elements without a name of which a scene has one; they are called by what they are.
constexpr std::array<std::string_view, 3> nameless{"scene", "wavelengths", "background"};

struct NamedElement {
    std::string_view kind;
    std::string name;
    pugi::xml_node node;
};

/// The kind whose names the element shares; empty if it cannot be named.
std::string_view kindOf(std::string_view element) {
    if (element == "instance" || element == "import") return "node";
    const auto found = std::find(kinds.begin(), kinds.end(), element);
    return found == kinds.end() ? std::string_view() : *found;
}

/// Every named element, in document order, without recursion.
std::vector<NamedElement> namedElements(pugi::xml_node root) {
    std::vector<NamedElement> result;
    for (pugi::xml_node node = root; node;) {
        const std::string_view element = node.name();
        if (const auto kind = kindOf(element); !kind.empty() && node.attribute("name"))
            result.push_back({kind, node.attribute("name").value(), node});
        if (std::find(nameless.begin(), nameless.end(), element) != nameless.end())
            result.push_back({element, std::string(element), node});
        if (node.first_child()) {
            node = node.first_child();
            continue;
        }
        while (node && node != root && !node.next_sibling())
            node = node.parent();
        node = node == root ? pugi::xml_node() : node.next_sibling();
    }
    return result;
}

struct Target {
    pugi::xml_node node;
    std::string attribute;
};

/// From a named element down through child elements: "diffuse.reflectance" behind a material's name.
Target descend(pugi::xml_node node, std::span<const std::string_view> path, const std::string& option) {
    for (const std::string_view step : path.first(path.size() - 1)) {
        const std::string name(step);
        const pugi::xml_node child = node.child(name.c_str());
        if (!child) {
            std::vector<std::string> there;
            for (const pugi::xml_node other : node.children())
                if (other.type() == pugi::node_element &&
                    std::find(there.begin(), there.end(), other.name()) == there.end())
                    there.emplace_back(other.name());
            throw UsageError(fmt::format(
                "{}: <{}> has no <{}> (allowed: {})", option, node.name(), name,
                there.empty() ? "none, it has no elements" : fmt::format("{}", fmt::join(there, ", "))));
        }
        if (child.next_sibling(name.c_str()))
            throw UsageError(fmt::format("{}: <{}> has several <{}> (give the one meant a node with a name)",
                                         option, node.name(), name));
        node = child;
    }
    return {node, std::string(path.back())};
}

[[noreturn]] void failUnknown(const std::string& option, const std::string& name, const std::string& kind,
                              const std::vector<NamedElement>& elements) {
    std::vector<std::string> known;
    for (const NamedElement& element : elements)
        if (kind.empty() || kind == element.kind) known.push_back(element.name);
    const std::string what = kind.empty() ? "element" : kind;
    if (known.empty()) throw UsageError(fmt::format("{}: the scene names no {}", option, what));
    const auto near = nearest(name, known);
    known.resize(std::min<size_t>(known.size(), 12));
    throw UsageError(fmt::format(
        "{}: no {} is named '{}' ({})", option, what, name,
        near ? "did you mean '" + *near + "'?" : fmt::format("allowed: {}", fmt::join(known, ", "))));
}

/// `path` is what stands before '='. Names may contain dots themselves: the longest name that exists counts.
Target findTarget(const std::string& option, std::string_view path,
                  const std::vector<NamedElement>& elements) {
    std::string kind;
    if (const size_t colon = path.find(':'); colon != std::string_view::npos) {
        const std::string_view prefix = path.substr(0, colon);
        if (std::find(kinds.begin(), kinds.end(), prefix) != kinds.end()) {
            kind = prefix;
            path.remove_prefix(colon + 1);
        }
    }
    const std::vector<std::string_view> pieces = split(path, '.');
    for (size_t length = pieces.size() - 1; length > 0; --length) {
        const std::string name = fmt::format(
            "{}", fmt::join(pieces.begin(), pieces.begin() + static_cast<ptrdiff_t>(length), "."));
        std::vector<const NamedElement*> found;
        for (const NamedElement& element : elements)
            if (element.name == name && (kind.empty() || kind == element.kind)) found.push_back(&element);
        if (found.empty()) continue;
        const bool oneKind = std::all_of(found.begin(), found.end(), [&](const NamedElement* other) {
            return other->kind == found.front()->kind;
        });
        if (!oneKind) {
            std::vector<std::string> ways;
            ways.reserve(found.size());
            for (const NamedElement* candidate : found)
                ways.push_back(fmt::format("{}:{}", candidate->kind, path));
            throw UsageError(fmt::format("{}: '{}' names several elements (write {})", option, name,
                                         fmt::join(ways, " or ")));
        }
        return descend(found.front()->node, std::span(pieces).subspan(length), option);
    }
    failUnknown(option, std::string(pieces.front()), kind, elements);
}

}  // namespace

void applyOverrides(XmlDocument& document, std::span<const std::string> options) {
    for (const std::string& text : options) {
        const std::string option = "--set " + text;
        const size_t equals = text.find('=');
        const std::string_view path = trimmed(std::string_view(text).substr(0, equals));
        const std::string_view attribute =
            path.substr(path.rfind('.') == std::string_view::npos ? path.size() : path.rfind('.') + 1);
        if (equals == std::string::npos || attribute.empty())
            throw UsageError(
                fmt::format("{}: expected NODE.ATTR=VALUE, as in lamp.spectrum=illuminants/A", option));
        // Collected anew each time: an option before may have changed a name.
        const Target target = findTarget(option, path, namedElements(document.root()));
        document.setAttribute(target.node, target.attribute,
                              std::string(trimmed(std::string_view(text).substr(equals + 1))), option);
    }
}

}  // namespace spectrad
