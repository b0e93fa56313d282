// spectrad info --list: the library, folder by folder.
#include "base/text.h"
#include "cli/info.h"
#include "spectrum/library.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace spectrad {

namespace {

Json described(const LibraryEntry& entry) {
    return {{"name", entry.name},       {"quantity", name(entry.quantity)},
            {"unit", entry.unit},       {"relative", entry.relative},
            {"title", entry.title},     {"channels", entry.channels},
            {"from_nm", entry.fromNm},  {"to_nm", entry.toNm},
            {"samples", entry.samples}, {"source", entry.source},
            {"licence", entry.licence}};
}

std::string folderOf(const std::string& name) {
    const size_t slash = name.rfind('/');
    return slash == std::string::npos ? std::string() : name.substr(0, slash);
}

void printTable(const std::vector<LibraryEntry>& entries) {
    size_t width = 0;
    for (const LibraryEntry& entry : entries)
        width = std::max(width, entry.name.size());
    std::string folder;
    for (const LibraryEntry& entry : entries) {
        if (folderOf(entry.name) != folder) {
            if (!folder.empty()) printText("\n");
            folder = folderOf(entry.name);
        }
        printText(fmt::format("{:<{}}  {} to {} nm, {} samples; {}{}\n", entry.name, width,
                              rounded(entry.fromNm, 6), rounded(entry.toNm, 6), entry.samples,
                              name(entry.quantity), entry.title.empty() ? "" : "; " + entry.title));
    }
}

}  // namespace

void printLibrary(const Library& library, const std::string& prefix, bool json) {
    std::vector<LibraryEntry> entries = library.list();
    std::erase_if(entries, [&](const LibraryEntry& entry) { return !startsWith(entry.name, prefix); });
    if (entries.empty())
        throw InputError("the library has no spectrum whose name starts with '" + prefix + "'" +
                         didYouMean(prefix, library.names()));
    if (!json) return printTable(entries);
    Json list = Json::array();
    for (const LibraryEntry& entry : entries)
        list.push_back(described(entry));
    printJson(list);
}

}  // namespace spectrad
