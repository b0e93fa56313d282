#include "base/text.h"
#include "spectrum/readers/reader.h"

#include <fmt/format.h>

namespace spectrad {

SpectrumTable readPairs(std::string_view text, const SourceLocation& where) {
    SpectrumTable table;
    table.header = {"value"};
    table.columns.resize(1);
    for (std::string_view word : words(text)) {
        const auto parts = split(word, ':');
        const auto nm = parseDouble(parts.front()), value = parseDouble(parts.back());
        if (parts.size() != 2 || !nm || !value)
            throw InputError(
                where,
                fmt::format(
                    "'{}' is not a pair nm:value (allowed: pairs of finite numbers with blanks between, "
                    "as in 400:0.1 700:0.3)",
                    word));
        if (!(*nm > 0))
            throw InputError(where, fmt::format("wavelength {} nm (allowed: above 0)", shortest(*nm)));
        if (!table.nm.empty() && *nm == table.nm.back())
            throw InputError(where, fmt::format("two values at {} nm", shortest(*nm)));
        if (!table.nm.empty() && *nm < table.nm.back())
            throw InputError(where, fmt::format("wavelengths must ascend, but {} nm follows {} nm",
                                                shortest(*nm), shortest(table.nm.back())));
        table.nm.push_back(*nm);
        table.columns.front().push_back(*value);
    }
    if (table.nm.empty()) throw InputError(where, "no pairs nm:value (allowed: as in 400:0.1 700:0.3)");
    return table;
}

}  // namespace spectrad
