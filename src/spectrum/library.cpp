#include "spectrum/library.h"

#include "base/files.h"
#include "base/text.h"
#include "spectrum/readers/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>

namespace spectrad {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view extension = ".csv";

/// What stands above the rows of a file: enough to list it without reading it.
struct Head {
    std::map<std::string, std::string, std::less<>> keys;
    std::vector<std::string> channels;
};

Head readHead(const fs::path& file) {
    std::ifstream in(file);
    if (!in) throw InputError(fmt::format("{}: cannot be read", file.string()));
    Head head;
    std::string text;
    while (std::getline(in, text)) {
        const std::string_view line = trimmed(text);
        if (line.empty()) continue;
        if (line.front() != '#') {
            const auto cells = split(line, ',');
            head.channels.assign(cells.begin() + 1, cells.end());
            break;
        }
        const size_t colon = line.find(':');
        if (colon != std::string_view::npos)
            head.keys.emplace(trimmed(line.substr(1, colon - 1)), trimmed(line.substr(colon + 1)));
    }
    if (head.channels.empty())
        throw InputError(fmt::format("{}: has no line of column names after its head", file.string()));
    return head;
}

const std::string& value(const Head& head, std::string_view key, const fs::path& file) {
    const auto found = head.keys.find(key);
    if (found == head.keys.end() || found->second.empty())
        throw InputError(fmt::format("{}: has no line '# {}: …' in its head", file.string(), key));
    return found->second;
}

/// "380-780 nm, 5 nm, 81 samples"
void readRange(const std::string& text, LibraryEntry& entry) {
    const auto pieces = split(text, ',');
    const auto ends = words(pieces.front());
    const auto count = words(pieces.back());
    if (pieces.size() == 3 && ends.size() == 2 && ends[1] == "nm" && count.size() == 2 &&
        count[1] == "samples") {
        const auto limits = split(ends[0], '-');
        const double from = parseDouble(limits.front()).value_or(0);
        const double to = parseDouble(limits.back()).value_or(0);
        const long long samples = parseInteger(count[0]).value_or(0);
        if (limits.size() == 2 && from > 0 && from <= to && samples > 0) {
            entry.fromNm = from;
            entry.toNm = to;
            entry.samples = static_cast<size_t>(samples);
            return;
        }
    }
    throw InputError(fmt::format("{}: '# range: {}' should be like '380-780 nm, 5 nm, 81 samples'",
                                 entry.file.string(), text));
}

LibraryEntry readEntry(std::string name, const fs::path& file) {
    Head head = readHead(file);
    LibraryEntry entry;
    entry.name = std::move(name);
    entry.file = file;
    entry.title = value(head, "title", file);
    entry.quantity = parseQuantity(value(head, "quantity", file), {file.string()});
    entry.unit = value(head, "unit", file);
    entry.source = value(head, "source", file);
    entry.licence = value(head, "licence", file);
    const std::string& relative = value(head, "relative", file);
    if (relative != "yes" && relative != "no")
        throw InputError(fmt::format("{}: '# relative: {}' (allowed: yes, no)", file.string(), relative));
    entry.relative = relative == "yes";
    readRange(value(head, "range", file), entry);
    entry.channels = std::move(head.channels);
    return entry;
}

/// Charts: every column is a sample of its own. The columns of the others (X Y Z, n k, …) belong together.
bool holdsSamples(const LibraryEntry& entry) {
    return entry.channels.size() > 1 &&
           (entry.quantity == Quantity::reflectance || entry.quantity == Quantity::transmittance);
}

/// Whether a name can be a path below the folder: plain pieces, none of which is hidden or leads out of it.
bool staysInside(std::string_view name) {
    for (std::string_view piece : split(name, '/'))
        if (piece.empty() || piece.front() == '.') return false;
    return std::ranges::none_of(name, [](unsigned char c) { return c < 0x20 || c == '\\'; });
}

bool isFolder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

/// All channels of a file, after checking that its rows are what its head promises: a file that was cut off
/// is noticed.
Spectrum readSpectrum(std::string name, const fs::path& file) {
    LibraryEntry entry = readEntry(std::move(name), file);
    SpectrumTable table = readTable(file);
    if (table.header != entry.channels || table.columns.size() != entry.channels.size())
        throw InputError(
            fmt::format("{}: its columns are not those of its line of column names", file.string()));
    if (table.nm.size() != entry.samples || table.nm.front() != entry.fromNm || table.nm.back() != entry.toNm)
        throw InputError(
            fmt::format("{}: has {} samples from {} to {} nm, but its head says {} from {} to {} nm",
                        file.string(), table.nm.size(), shortest(table.nm.front()), shortest(table.nm.back()),
                        entry.samples, shortest(entry.fromNm), shortest(entry.toNm)));
    const bool surface = entry.quantity == Quantity::reflectance ||
                         entry.quantity == Quantity::transmittance || entry.quantity == Quantity::index;
    Spectrum spectrum;
    for (std::vector<double>& column : table.columns)
        spectrum.curves.push_back(
            Curve::table(table.nm, std::move(column), surface ? Outside::hold : Outside::zero));
    spectrum.text = std::move(entry.name);
    spectrum.quantity = entry.quantity;
    spectrum.unit = std::move(entry.unit);
    spectrum.relative = entry.relative;
    spectrum.channels = std::move(entry.channels);
    spectrum.files = {file};
    spectrum.source = std::move(entry.source);
    spectrum.licence = std::move(entry.licence);
    return spectrum;
}

struct NamedFile {
    std::string name;
    fs::path path;
};

std::vector<NamedFile> files(const fs::path& folder) {
    std::vector<NamedFile> result;
    try {
        for (const fs::directory_entry& found : fs::recursive_directory_iterator(folder)) {
            const std::string name =
                found.path().lexically_relative(folder).replace_extension().generic_string();
            // A name without a folder belongs to the scene's own spectra.
            if (found.path().extension() == extension && name.find('/') != std::string::npos &&
                staysInside(name) && isFile(found.path()))
                result.push_back({name, found.path()});
        }
    } catch (const fs::filesystem_error& error) {
        throw MachineError(fmt::format("{}: the library of spectra cannot be read: {}", folder.string(),
                                       error.code().message()));
    }
    return result;
}

}  // namespace

Library::Library(fs::path folder) : folder_(std::move(folder)) {
    if (!isFolder(folder_))
        throw MachineError(fmt::format("{}: there is no folder of spectra", folder_.string()));
}

Library Library::open() {
    if (const char* chosen = std::getenv("SPECTRAD_SPECTRA"); chosen && *chosen) {
        if (!isFolder(chosen))
            throw MachineError(fmt::format("{}: SPECTRAD_SPECTRA should name the folder of spectra", chosen));
        return Library(chosen);
    }
    std::vector<fs::path> places;
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    if (!program.empty()) places.push_back(program.parent_path().parent_path() / "share/spectrad/spectra");
    places.emplace_back(SPECTRAD_SPECTRA_DIR);
    std::string tried;
    for (const fs::path& place : places) {
        if (isFolder(place)) return Library(place);
        tried += (tried.empty() ? "" : ", ") + place.string();
    }
    throw MachineError(fmt::format("no folder of spectra (tried: {}); SPECTRAD_SPECTRA can name it", tried));
}

std::optional<Spectrum> Library::find(std::string_view name) const {
    const size_t slash = name.rfind('/');
    if (slash == std::string_view::npos || !staysInside(name)) return std::nullopt;
    const auto pathOf = [&](std::string_view file) {
        return folder_ / (std::string(file) + std::string(extension));
    };
    if (const fs::path whole = pathOf(name); isFile(whole)) return readSpectrum(std::string(name), whole);

    const std::string_view file = name.substr(0, slash), column = name.substr(slash + 1);
    if (file.find('/') == std::string_view::npos || !isFile(pathOf(file))) return std::nullopt;
    Spectrum spectrum = readSpectrum(std::string(name), pathOf(file));
    const auto found = std::ranges::find(spectrum.channels, column);
    if (found == spectrum.channels.end()) return std::nullopt;
    spectrum.curves = {spectrum.curves[static_cast<size_t>(found - spectrum.channels.begin())]};
    spectrum.channels = {std::string(column)};
    return spectrum;
}

std::vector<LibraryEntry> Library::list() const {
    std::vector<LibraryEntry> entries;
    for (const NamedFile& file : files(folder_)) {
        LibraryEntry entry = readEntry(file.name, file.path);
        if (holdsSamples(entry))
            for (const std::string& channel : entry.channels) {
                LibraryEntry sample = entry;
                sample.name += '/' + channel;
                sample.title += ": " + channel;
                sample.channels = {channel};
                entries.push_back(std::move(sample));
            }
        entries.push_back(std::move(entry));
    }
    std::ranges::sort(entries, {}, &LibraryEntry::name);
    return entries;
}

std::vector<std::string> Library::names() const {
    std::vector<std::string> result;
    for (const NamedFile& file : files(folder_)) {
        result.push_back(file.name);
        try {
            const LibraryEntry entry = readEntry(file.name, file.path);
            if (holdsSamples(entry))
                for (const std::string& channel : entry.channels)
                    result.push_back(file.name + '/' + channel);
        } catch (const InputError&) {
            // Names are asked for while another error is being worded: a damaged file must not take its
            // place.
        }
    }
    std::ranges::sort(result);
    return result;
}

}  // namespace spectrad
