#include "cli/help.h"

#include "base/text.h"

#include <algorithm>

namespace spectrad {

namespace {

constexpr size_t labelColumn = 34, lineWidth = 100;

/// Columns that `text` takes on the screen: UTF-8 continuation bytes take none.
size_t columns(std::string_view text) {
    size_t count = 0;
    for (char c : text)
        count += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    return count;
}

/// `text` in lines of at most lineWidth columns, each but the first indented by `indent`.
std::string wrapped(std::string_view text, size_t indent) {
    std::string out;
    size_t used = indent;
    for (std::string_view word : words(text)) {
        if (used > indent && used + 1 + columns(word) > lineWidth) {
            out += "\n" + std::string(indent, ' ');
            used = indent;
        } else if (used > indent) {
            out += ' ';
            ++used;
        }
        out += word;
        used += columns(word);
    }
    return out;
}

std::vector<std::string_view> lines(std::string_view text) {
    std::vector<std::string_view> out;
    for (size_t start = 0; start <= text.size();) {
        const size_t end = std::min(text.find('\n', start), text.size());
        out.push_back(text.substr(start, end - start));
        start = end + 1;
    }
    return out;
}

std::string entry(const std::string& label, const std::string& description) {
    std::string out = "  " + label;
    const size_t width = columns(out);
    out += width + 2 > labelColumn ? "\n" + std::string(labelColumn, ' ')
                                   : std::string(labelColumn - width, ' ');
    return out + wrapped(description, labelColumn) + "\n";
}

}  // namespace

HelpFormatter::HelpFormatter() {
    label("OPTIONS", "options");
    label("SUBCOMMAND", "command");
    label("Positionals", "Arguments");
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool positional) const {
    std::string name = make_option_name(option, positional);
    if (!positional && option->get_type_size() != 0) name += " " + option->get_type_name();
    return entry(name, option->get_description());
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
    return entry(command->get_name(), command->get_description());
}

/// Paragraphs are wrapped; examples, which are indented, stay as they are.
std::string HelpFormatter::make_footer(const CLI::App* app) const {
    const std::string footer = app->get_footer();
    std::string out;
    for (std::string_view line : lines(footer))
        out += (startsWith(line, " ") ? std::string(line) : wrapped(line, 0)) + "\n";
    return out;
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
    return wrapped(app->get_description(), 0) + "\n\n";
}

}  // namespace spectrad
