// Reading a display's file, and choosing a display by name.
#include "base/files.h"
#include "base/text.h"
#include "colour/display.h"

#include <algorithm>
#include <map>
#include <vector>

namespace spectrad {

namespace {

struct Word {
    std::string_view text;
    SourceLocation where;
};

/// The words of a line with their places; what follows `#` is a comment.
std::vector<Word> wordsOf(std::string_view line, const std::string& file, int number) {
    std::vector<Word> result;
    line = line.substr(0, line.find('#'));
    for (std::string_view word : words(line))
        result.push_back({word, {file, number, static_cast<int>(word.data() - line.data()) + 1}});
    return result;
}

double numberIn(const Word& word, const char* what, double least, double most) {
    const auto value = parseDouble(word.text);
    if (!value || *value < least || *value > most)
        throw InputError(word.where, "'" + std::string(word.text) + "' is no " + what +
                                         " (allowed: " + shortest(least) + " to " + shortest(most) + ")");
    return *value;
}

std::array<double, 2> chromaticityIn(const std::vector<Word>& line) {
    if (line.size() != 3)
        throw InputError(line[0].where,
                         "'" + std::string(line[0].text) + "' needs two numbers, the chromaticity x y");
    // Wide enough for imaginary primaries such as those of ACES and ProPhoto.
    return {numberIn(line[1], "chromaticity x", -1, 2), numberIn(line[2], "chromaticity y", -1, 2)};
}

const std::vector<std::string>& settings() {
    static const std::vector<std::string> names{"red", "green", "blue", "white", "gamma", "transfer"};
    return names;
}

}  // namespace

Display parseDisplay(std::string_view text, const std::string& file) {
    std::map<std::string, std::array<double, 2>, std::less<>> points;
    auto transfer = Display::Transfer::srgb;
    double gamma = 2.2;
    SourceLocation transferAt;

    for (int number = 1; !text.empty(); ++number) {
        const size_t end = std::min(text.find('\n'), text.size());
        const std::vector<Word> parts = wordsOf(text.substr(0, end), file, number);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (parts.empty()) continue;
        const Word& key = parts[0];
        if (key.text == "red" || key.text == "green" || key.text == "blue" || key.text == "white") {
            const std::array<double, 2> point = chromaticityIn(parts);
            if (key.text == "white" && !(point[1] > 0))
                throw InputError(parts[2].where, "white needs a chromaticity y above 0");
            if (!points.emplace(key.text, point).second)
                throw InputError(key.where, "'" + std::string(key.text) + "' is given twice");
        } else if (key.text == "gamma" || key.text == "transfer") {
            if (transferAt.line > 0)
                throw InputError(key.where, "a display has one 'gamma' or 'transfer'; the first is in line " +
                                                std::to_string(transferAt.line));
            if (parts.size() != 2)
                throw InputError(key.where, "'" + std::string(key.text) + "' needs one value");
            transferAt = key.where;
            if (key.text == "gamma") {
                transfer = Display::Transfer::gamma;
                gamma = numberIn(parts[1], "gamma", 0.1, 10);
            } else if (parts[1].text == "rec2020") {
                transfer = Display::Transfer::rec2020;
            } else if (parts[1].text != "srgb") {
                throw InputError(parts[1].where, "unknown transfer '" + std::string(parts[1].text) +
                                                     "' (allowed: srgb, rec2020)");
            }
        } else {
            throw InputError(key.where,
                             "unknown setting '" + std::string(key.text) +
                                 "' of a display (allowed: red, green, blue, white, gamma, transfer)" +
                                 didYouMean(key.text, settings()));
        }
    }
    for (const char* needed : {"red", "green", "blue", "white"})
        if (!points.count(needed))
            throw InputError(SourceLocation{file},
                             "a display needs a line '" + std::string(needed) + " x y' (chromaticity)");
    try {
        Display display = displayFromPrimaries({points["red"], points["green"], points["blue"]},
                                               points["white"], transfer, gamma);
        display.name = file;
        return display;
    } catch (const InputError& error) {
        throw InputError(SourceLocation{file}, error.what());
    }
}

Display displayFor(const std::string& text) {
    if (text == "srgb") return srgbDisplay();
    if (text == "p3") return p3Display();
    if (text == "rec2020") return rec2020Display();
    std::error_code none;
    if (!std::filesystem::exists(text, none)) {
        const std::vector<std::string> known{"srgb", "p3", "rec2020"};
        throw UsageError("unknown display '" + text +
                         "', and no file of that name (allowed: srgb, p3, rec2020, or a file of " +
                         "primaries)" + didYouMean(text, known));
    }
    return parseDisplay(readFile(text, 1u << 20), text);
}

}  // namespace spectrad
