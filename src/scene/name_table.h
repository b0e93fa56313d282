// Names of one kind (materials, nodes, lights …): unique, with the place where each was given.
#pragma once

#include "base/error.h"
#include "scene/scene.h"

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace spectrad {

class NameTable {
  public:
    explicit NameTable(std::string kind) : kind_(std::move(kind)) {}

    /// Throws InputError for a name that is taken, naming the first place. An empty name is none and not
    /// kept.
    void add(const std::string& name, Index index, const SourceLocation& where);
    /// A name that comes from a foreign file: kept where it is free.
    void addImported(const std::string& name, Index index);
    /// Throws InputError at `where` for a name that is not there: the nearest, or those there are.
    [[nodiscard]] Index find(const std::string& name, const SourceLocation& where) const;
    [[nodiscard]] bool has(const std::string& name) const { return entries_.contains(name); }

  private:
    struct Entry {
        Index index;
        SourceLocation where;
    };
    std::string kind_;
    std::unordered_map<std::string, Entry> entries_;
};

}  // namespace spectrad
