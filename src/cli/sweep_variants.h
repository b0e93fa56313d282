// What a sweep goes through: the command line's --vary, --observer and --region, or the scene's own <sweep>.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace spectrad {

/// "A.x+B.y=one|two" of --vary. Throws UsageError.
[[nodiscard]] SweepAxis parseAxis(const std::string& text);
/// "NAME=X,Y,WIDTH,HEIGHT" of --region, in pixels. Throws UsageError.
[[nodiscard]] Region parseRegion(const std::string& text);

struct SweepVariant {
    std::string name;  ///< its values with dashes between, as files may be called; "scene" without
    std::vector<std::string> set;  ///< what --set would be given
    bool numbered = false;         ///< its name has a number behind it, since another one has that name
    SourceLocation where;          ///< of the last axis; without a file, the command line
};
/// All combinations, the last axis fastest, no two of one name. Throws InputError beyond 10 000.
[[nodiscard]] std::vector<SweepVariant> variantsOf(const std::vector<SweepAxis>& axes);

/// Text as a part of a file's name.
[[nodiscard]] std::string fileName(std::string text);
/// The names, with -2, -3 … behind those that stand before them already.
[[nodiscard]] std::vector<std::string> distinct(std::vector<std::string> names);

/// The scene's <sweep> of that name; with an empty name its only one, or none. Throws UsageError.
[[nodiscard]] const Sweep* chooseSweep(const Scene& scene, const std::string& name);

}  // namespace spectrad
