// A scene's file with attributes changed: every byte that no change is about stays, comments and layout
// included.
#pragma once

#include "scene/xml_document.h"

#include <span>
#include <string>

namespace spectrad {

class SceneText {
  public:
    /// `bytes` are the file's. Throws InputError for what is no XML of ours.
    SceneText(std::string bytes, std::string file);

    /// As --set (set_overrides.h). Throws UsageError.
    void apply(std::span<const std::string> options);
    /// Attributes of the element that begins at a place, or of its child `<child>`: written, or removed if
    /// the value is empty. Throws InputError if no element begins there.
    void set(const SourceLocation& place, const std::string& child, const std::string& attribute,
             const std::string& value);
    [[nodiscard]] std::string get(const SourceLocation& place, const std::string& attribute) const;
    /// An element more, last in the scene.
    void append(const std::string& element);

    /// The file as it would be written.
    [[nodiscard]] std::string text() const;

  private:
    [[nodiscard]] pugi::xml_node elementAt(const SourceLocation& place) const;

    std::string bytes_, file_, appended_;
    XmlDocument original_, changed_;
};

}  // namespace spectrad
