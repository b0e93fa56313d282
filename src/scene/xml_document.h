// An XML file in memory with the place of every element: parsed by pugixml, checked beforehand for what it
// lets pass.
#pragma once

#include "base/error.h"

#include <pugixml.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spectrad {

class XmlDocument {
  public:
    /// `bytes` are the file's, UTF-8 with or without a byte order mark; `file` names it in errors. Throws
    /// InputError for what is not well-formed, for a DOCTYPE, and for entities beyond the five that XML
    /// itself defines: nothing in a scene may expand into more than it says.
    XmlDocument(std::string_view bytes, std::string file);
    XmlDocument(const XmlDocument&) = delete;
    XmlDocument& operator=(const XmlDocument&) = delete;

    [[nodiscard]] pugi::xml_node root() const { return document_.document_element(); }
    /// Line and column (in bytes, from 1) of the '<' of an element, or where a text begins.
    [[nodiscard]] SourceLocation where(pugi::xml_node node) const;
    /// The element's place; for an attribute that --set wrote, the option itself.
    [[nodiscard]] SourceLocation where(pugi::xml_node node, pugi::xml_attribute attribute) const;

    /// Writes (or with an empty value removes) an attribute; errors about it will name `option`.
    void setAttribute(pugi::xml_node node, const std::string& attribute, const std::string& value,
                      std::string option);

  private:
    [[nodiscard]] SourceLocation at(size_t offset) const;
    void parse(std::string_view text);

    std::string file_;
    std::vector<size_t> lineStart_;  ///< offset of each line's first byte
    pugi::xml_document document_;
    std::vector<std::pair<pugi::xml_attribute, std::string>> overrides_;
};

}  // namespace spectrad
