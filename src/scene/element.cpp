#include "scene/element.h"

#include "base/limits.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace spectrad {

bool Bounds::contain(double value) const {
    return (lowCounts ? value >= low : value > low) && (highCounts ? value <= high : value < high);
}

std::string Bounds::text() const {
    const bool below = std::isfinite(low), above = std::isfinite(high);
    if (below && above && lowCounts && highCounts) return fmt::format("a number from {} to {}", low, high);
    if (below && above)
        return fmt::format("a number {} {} and {} {}", lowCounts ? "of at least" : "above", low,
                           highCounts ? "at most" : "below", high);
    if (below) return fmt::format("a number {} {}", lowCounts ? "of at least" : "above", low);
    return "a number";
}

SourceLocation Element::where(const char* attribute) const {
    return document_->where(node_, node_.attribute(attribute));
}

std::optional<Element> Element::child(const char* element) const {
    const pugi::xml_node found = node_.child(element);
    if (!found) return std::nullopt;
    return Element(*document_, found);
}

std::string Element::body() const {
    std::string text;
    for (const pugi::xml_node piece : node_.children())
        if (piece.type() == pugi::node_pcdata || piece.type() == pugi::node_cdata) text += piece.value();
    return text;
}

SourceLocation Element::whereBody() const {
    return document_->where(node_.first_child() ? node_.first_child() : node_);
}

std::string Element::text(const char* attribute) const {
    const pugi::xml_attribute found = node_.attribute(attribute);
    const std::string_view value = trimmed(found.value());
    if (found && value.empty())
        throw InputError(where(attribute), fmt::format("attribute '{}' of <{}> is empty", attribute, name()));
    return std::string(value);
}

double Element::number(const char* attribute, double fallback, Bounds bounds) const {
    if (!has(attribute)) return fallback;
    const auto value = parseDouble(text(attribute));
    if (!value || !bounds.contain(*value)) fail(attribute, "expected " + bounds.text());
    return *value;
}

int Element::integer(const char* attribute, int fallback, int low, int high) const {
    if (!has(attribute)) return fallback;
    const auto value = parseInteger(text(attribute));
    if (!value || *value < low || *value > high)
        fail(attribute, fmt::format("expected a whole number from {} to {}", low, high));
    return static_cast<int>(*value);
}

std::vector<double> Element::numbers(const char* attribute, std::initializer_list<size_t> counts) const {
    const std::string value = text(attribute);
    const std::vector<std::string_view> pieces = words(value);
    const std::string expected = fmt::format("{} numbers with blanks between", fmt::join(counts, " or "));
    if (std::find(counts.begin(), counts.end(), pieces.size()) == counts.end())
        fail(attribute, fmt::format("expected {}, found {}", expected, pieces.size()));
    std::vector<double> result;
    for (std::string_view piece : pieces) {
        const auto number = parseDouble(piece);
        if (!number) fail(attribute, fmt::format("'{}' is not a number (expected {})", piece, expected));
        result.push_back(*number);
    }
    return result;
}

Vec3 Element::vector(const char* attribute, Vec3 fallback) const {
    if (!has(attribute)) return fallback;
    const std::vector<double> v = numbers(attribute, {3});
    return {v[0], v[1], v[2]};
}

bool Element::boolean(const char* attribute, bool fallback) const {
    return choice<bool>(attribute, {{"true", true}, {"false", false}}, fallback);
}

std::pair<int, int> Element::pixels(const char* attribute, std::pair<int, int> fallback) const {
    if (!has(attribute)) return fallback;
    const std::string value = text(attribute);
    const auto sides = split(value, 'x');
    const auto width = sides.size() == 2 ? parseInteger(sides[0]) : std::nullopt;
    const auto height = sides.size() == 2 ? parseInteger(sides[1]) : std::nullopt;
    if (!width || !height) fail(attribute, "expected WIDTHxHEIGHT in pixels, as in 1280x720");
    if (*width < 1 || *height < 1 || *width > largestSide || *height > largestSide)
        fail(attribute, fmt::format("each side has 1 to {} pixels", largestSide));
    return {static_cast<int>(*width), static_cast<int>(*height)};
}

std::pair<double, double> Element::sides(const char* attribute) const {
    const std::string value = text(attribute);
    const auto pieces = split(value, 'x');
    const auto width = pieces.size() == 2 ? parseDouble(pieces[0]) : std::nullopt;
    const auto height = pieces.size() == 2 ? parseDouble(pieces[1]) : std::nullopt;
    if (!width || !height || !(*width > 0) || !(*height > 0))
        fail(attribute, "expected two lengths above 0, as in 36x24");
    return {*width, *height};
}

void Element::fail(const char* attribute, const std::string& message) const {
    std::string value = node_.attribute(attribute).value();
    if (value.size() > 60) {
        value.resize(57);
        while (!value.empty() && (static_cast<unsigned char>(value.back()) & 0xC0) == 0x80)
            value.pop_back();
        value += "...";
    }
    std::replace_if(
        value.begin(), value.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
    throw InputError(where(attribute),
                     fmt::format("{}=\"{}\" in <{}>: {}", attribute, value, name(), message));
}

void Element::fail(const std::string& message) const {
    throw InputError(where(), fmt::format("<{}> {}", name(), message));
}

void Element::refuse(const char* attribute, const std::string& why) const {
    if (has(attribute))
        throw InputError(where(attribute), fmt::format("attribute '{}' of <{}> {}", attribute, name(), why));
}

void Element::failChoice(const char* attribute, const std::vector<std::string>& allowed) const {
    const auto near = nearest(node_.attribute(attribute).value(), allowed);
    fail(attribute, fmt::format("unknown value (allowed: {}{})", fmt::join(allowed, ", "),
                                near ? "; did you mean '" + *near + "'?" : ""));
}

}  // namespace spectrad
