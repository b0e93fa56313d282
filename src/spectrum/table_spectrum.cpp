#include "spectrum/table_spectrum.h"

#include "base/text.h"
#include "spectrum/role.h"

#include <fmt/format.h>

#include <algorithm>

namespace spectrad {

namespace {

std::string headOf(const SpectrumTable& table, const std::string& key) {
    const auto found = table.head.find(key);
    return found == table.head.end() ? std::string() : found->second;
}

/// What the file says it is; other programs' files describe it in words of their own, which say nothing
/// certain.
Quantity quantityOf(const SpectrumTable& table) {
    try {
        return parseQuantity(headOf(table, "quantity"), {});
    } catch (const InputError&) {
        return Quantity::unknown;
    }
}

/// Which of the value columns is meant.
size_t columnIndex(const SpectrumTable& table, const std::string& file, const std::string& column,
                   const SourceLocation& where) {
    const auto named = std::find(table.header.begin(), table.header.end(), column);
    if (const auto number = parseInteger(column)) {
        if (*number >= 2 && *number <= static_cast<long long>(table.columns.size()) + 1)
            return static_cast<size_t>(*number - 2);
        if (named == table.header.end())
            throw InputError(
                where, fmt::format("'{}' has no column {} of values (allowed: 2 … {}; 1 is the wavelength)",
                                   file, column, table.columns.size() + 1));
    }
    if (named == table.header.end())
        throw InputError(where, fmt::format("'{}' has no column '{}'{} (there are: {})", file, column,
                                            didYouMean(column, table.header), fmt::join(table.header, ", ")));
    return static_cast<size_t>(named - table.header.begin());
}

}  // namespace

Spectrum oneChannel(Spectrum spectrum, size_t channel) {
    spectrum.curves = {spectrum.curves[channel]};
    if (channel < spectrum.channels.size()) spectrum.channels = {spectrum.channels[channel]};
    return spectrum;
}

Spectrum tableSpectrum(SpectrumTable table, const std::string& file, const std::string& column, Role role,
                       const SourceLocation& where) {
    const std::string relative = headOf(table, "relative");
    Spectrum spectrum;
    spectrum.text = column.empty() ? file : file + "#" + column;
    spectrum.quantity = quantityOf(table);
    spectrum.unit = headOf(table, "unit");
    spectrum.relative = relative == "yes" || relative == "true";
    spectrum.source = headOf(table, "source");
    spectrum.licence = headOf(table, "licence");
    for (const std::vector<double>& values : table.columns)
        spectrum.curves.push_back(Curve::table(table.nm, values));
    spectrum.channels = table.header;
    if (!column.empty()) return oneChannel(std::move(spectrum), columnIndex(table, file, column, where));
    if (takesChannels(role)) return spectrum;
    return oneChannel(std::move(spectrum), channelFor(role, table.header).value_or(0));
}

Spectrum pairsSpectrum(std::string_view text, const SourceLocation& where) {
    SpectrumTable table = readPairs(text, where);
    Spectrum spectrum;
    spectrum.text = trimmed(text);
    spectrum.curves = {Curve::table(std::move(table.nm), std::move(table.columns.front()))};
    spectrum.channels = std::move(table.header);
    return spectrum;
}

}  // namespace spectrad
