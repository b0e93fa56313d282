// spectrad info --list: the library, folder by folder.
#include "base/text.h"
#include "camera/film.h"
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

/// A line of the list.
struct Row {
    std::string name, what;
    Json json;
};

Row rowOf(const LibraryEntry& entry) {
    return {entry.name,
            fmt::format("{} to {} nm, {} samples; {}{}", rounded(entry.fromNm, 6), rounded(entry.toNm, 6),
                        entry.samples, name(entry.quantity), entry.title.empty() ? "" : "; " + entry.title),
            described(entry)};
}

/// Films stand among the spectra that they are made of; what only a spectrum has is null.
Row rowOfFilm(const std::string& film) {
    Json json{{"name", film}, {"quantity", "film"}, {"title", "reversal film"}};
    for (const char* key :
         {"unit", "relative", "channels", "from_nm", "to_nm", "samples", "source", "licence"})
        json[key] = nullptr;
    return {film, "reversal film", std::move(json)};
}

void printTable(const std::vector<Row>& rows) {
    size_t width = 0;
    for (const Row& row : rows)
        width = std::max(width, row.name.size());
    std::string folder;
    for (const Row& row : rows) {
        if (folderOf(row.name) != folder) {
            if (!folder.empty()) printText("\n");
            folder = folderOf(row.name);
        }
        printText(fmt::format("{:<{}}  {}\n", row.name, width, row.what));
    }
}

}  // namespace

void printLibrary(const Library& library, const std::string& prefix, bool json) {
    std::vector<Row> rows;
    for (const LibraryEntry& entry : library.list())
        rows.push_back(rowOf(entry));
    for (const std::string& film : filmNames(library))
        rows.push_back(rowOfFilm(film));
    std::erase_if(rows, [&](const Row& row) { return !startsWith(row.name, prefix); });
    std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.name < b.name; });
    if (rows.empty())
        throw InputError("the library has no spectrum whose name starts with '" + prefix + "'" +
                         didYouMean(prefix, library.names()));
    if (!json) return printTable(rows);
    Json list = Json::array();
    for (Row& row : rows)
        list.push_back(std::move(row.json));
    printJson(list);
}

}  // namespace spectrad
