// The elements of a scene file: which attributes and children each takes. One table, read by the structural
// check, by
// --set and by the test that compares it with scenes/spectrad.rng.
#pragma once

#include "scene/xml_document.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spectrad {

struct ElementRule {
    struct Attribute {
        std::string name;
        bool required = false;
    };
    std::string name;
    std::vector<Attribute> attributes;
    std::vector<std::string> children;
    std::vector<std::string> once;  ///< of the children, those that may stand here only once
    bool text = false;

    [[nodiscard]] bool takes(std::string_view attribute) const;
};

[[nodiscard]] std::span<const ElementRule> grammar();
/// The rule of an element, or null.
[[nodiscard]] const ElementRule* findRule(std::string_view element);

/// Deepest nesting of elements that is read.
inline constexpr int maxDepth = 100'000;

/// Walks the whole document: every element in a place where it may stand, its attributes known, none twice,
/// the required ones there, no stray text, not deeper than maxDepth. Values are not looked at. Throws
/// InputError with the place.
void checkStructure(const XmlDocument& document);

/// "unknown attribute 'radios' in <sphere> (allowed: radius, material; did you mean 'radius'?)"
[[nodiscard]] std::string unknownAttribute(const ElementRule& rule, std::string_view attribute);

}  // namespace spectrad
