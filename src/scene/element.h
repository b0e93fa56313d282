// One element of a scene file with typed access to its attributes. Names were checked by checkStructure();
// here values are, and every error says the attribute as it was written, the element and what is allowed.
#pragma once

#include "base/vec.h"
#include "scene/xml_document.h"

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spectrad {

/// What a number may be; the ends count unless said otherwise.
struct Bounds {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool lowCounts = true, highCounts = true;

    [[nodiscard]] bool contain(double value) const;
    [[nodiscard]] std::string text() const;  ///< "a number above 0 and at most 180"
};
inline constexpr Bounds anyNumber{};
inline constexpr Bounds positive{0, std::numeric_limits<double>::infinity(), false, true};
inline constexpr Bounds notNegative{0, std::numeric_limits<double>::infinity(), true, true};
inline constexpr Bounds zeroToOne{0, 1, true, true};

class Element {
  public:
    Element(const XmlDocument& document, pugi::xml_node node) : document_(&document), node_(node) {}

    [[nodiscard]] std::string_view name() const { return node_.name(); }
    [[nodiscard]] pugi::xml_node node() const { return node_; }
    [[nodiscard]] const XmlDocument& document() const { return *document_; }
    [[nodiscard]] SourceLocation where() const { return document_->where(node_); }
    [[nodiscard]] SourceLocation where(const char* attribute) const;
    /// The child element of that name, if there is one.
    [[nodiscard]] std::optional<Element> child(const char* element) const;
    /// Texts and CDATA inside, joined; and where the first begins.
    [[nodiscard]] std::string body() const;
    [[nodiscard]] SourceLocation whereBody() const;

    [[nodiscard]] bool has(const char* attribute) const { return !node_.attribute(attribute).empty(); }
    /// The attribute without blanks around it, empty if it is not there. It may not be empty if it is there.
    [[nodiscard]] std::string text(const char* attribute) const;
    [[nodiscard]] double number(const char* attribute, double fallback, Bounds bounds = anyNumber) const;
    [[nodiscard]] int integer(const char* attribute, int fallback, int low, int high) const;
    /// Numbers with blanks between; as many as one of `counts` says.
    [[nodiscard]] std::vector<double> numbers(const char* attribute,
                                              std::initializer_list<size_t> counts) const;
    [[nodiscard]] Vec3 vector(const char* attribute, Vec3 fallback) const;
    [[nodiscard]] bool boolean(const char* attribute, bool fallback) const;
    /// "1280x720", each side 1 to largestSide.
    [[nodiscard]] std::pair<int, int> pixels(const char* attribute, std::pair<int, int> fallback) const;
    /// "36x24", each above 0.
    [[nodiscard]] std::pair<double, double> sides(const char* attribute) const;

    template <typename Enum>
    [[nodiscard]] Enum choice(const char* attribute,
                              std::initializer_list<std::pair<std::string_view, Enum>> options,
                              Enum fallback) const {
        if (!has(attribute)) return fallback;
        const std::string value = text(attribute);
        std::vector<std::string> allowed;
        for (const auto& [word, option] : options) {
            if (value == word) return option;
            allowed.emplace_back(word);
        }
        failChoice(attribute, allowed);
    }

    /// attribute="value" in <element>: message
    [[noreturn]] void fail(const char* attribute, const std::string& message) const;
    /// <element>: message, at its place.
    [[noreturn]] void fail(const std::string& message) const;
    /// An attribute that belongs to another kind of this element.
    void refuse(const char* attribute, const std::string& why) const;

  private:
    [[noreturn]] void failChoice(const char* attribute, const std::vector<std::string>& allowed) const;

    const XmlDocument* document_;
    pugi::xml_node node_;
};

}  // namespace spectrad
