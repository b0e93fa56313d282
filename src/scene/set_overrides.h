// --set NODE.ATTR=VALUE: changing a scene from the command line, before it is read.
#pragma once

#include "scene/xml_document.h"

#include <span>
#include <string>

namespace spectrad {

/// Applies the options in order. Throws UsageError for one that is malformed, or names nothing or several
/// elements; an attribute or value that the element does not take is found by the readers, as if it stood in
/// the file. An empty value removes the attribute.
void applyOverrides(XmlDocument& document, std::span<const std::string> options);

}  // namespace spectrad
