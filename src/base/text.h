// Numbers and words of text files, independent of the locale.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spectrad {

[[nodiscard]] std::string_view trimmed(std::string_view text);
/// Pieces between separators, trimmed; empty pieces are kept.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);
/// Pieces between runs of white space; none are empty.
[[nodiscard]] std::vector<std::string_view> words(std::string_view text);
[[nodiscard]] bool startsWith(std::string_view text, std::string_view start);

/// A–Z as a–z, whatever the locale.
[[nodiscard]] std::string lowerCase(std::string_view text);
/// Bytes of the UTF-8 character at `at`, or 0 if there is none (overlong forms and surrogates are none; RFC
/// 3629).
[[nodiscard]] size_t utf8Length(std::string_view text, size_t at);

/// The whole text as a finite decimal number (optional sign, no hex, no inf/nan), or nothing.
[[nodiscard]] std::optional<double> parseDouble(std::string_view text);
[[nodiscard]] std::optional<long long> parseInteger(std::string_view text);

/// Shortest text that reads back as the same double.
[[nodiscard]] std::string shortest(double value);
/// Fixed number of significant digits for people ("%.*g").
[[nodiscard]] std::string rounded(double value, int digits);

/// The known name nearest to `name` (Damerau–Levenshtein distance of at most a third of its length), or
/// nothing.
[[nodiscard]] std::optional<std::string> nearest(std::string_view name, std::span<const std::string> known);
/// " (did you mean 'x'?)" or "" — to end an error about an unknown name.
[[nodiscard]] std::string didYouMean(std::string_view name, std::span<const std::string> known);

}  // namespace spectrad
