#include "scene/name_table.h"

#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace spectrad {

void NameTable::add(const std::string& name, Index index, const SourceLocation& where) {
    if (name.empty()) return;
    const auto [entry, isNew] = entries_.try_emplace(name, Entry{index, where});
    if (!isNew)
        throw InputError(where, fmt::format("the name '{}' is taken by another {} at {}", name, kind_,
                                            entry->second.where.str()));
}

void NameTable::addImported(const std::string& name, Index index) {
    if (!name.empty()) entries_.try_emplace(name, Entry{index, {}});
}

Index NameTable::find(const std::string& name, const SourceLocation& where) const {
    if (const auto found = entries_.find(name); found != entries_.end()) return found->second.index;
    if (entries_.empty())
        throw InputError(where, fmt::format("unknown {} '{}' (the scene names none)", kind_, name));
    std::vector<std::string> known;
    for (const auto& [other, entry] : entries_)
        known.push_back(other);
    std::sort(known.begin(), known.end());
    if (const auto near = nearest(name, known))
        throw InputError(where, fmt::format("unknown {} '{}' (did you mean '{}'?)", kind_, name, *near));
    const size_t shown = std::min<size_t>(known.size(), 12);
    throw InputError(
        where, fmt::format("unknown {} '{}' (allowed: {}{})", kind_, name,
                           fmt::join(known.begin(), known.begin() + static_cast<ptrdiff_t>(shown), ", "),
                           shown < known.size() ? fmt::format(" and {} more", known.size() - shown) : ""));
}

}  // namespace spectrad
