// The text header of an ENVI raster: "ENVI", then "key = value" lines, lists in braces over as many lines as
// they need.
#pragma once

#include "image/cube.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spectrad {

namespace envi {

/// Ours, for what no key of the format says; the rest of the key is the name of the attribute.
inline constexpr std::string_view ourPrefix = "spectrad:";

struct Field {
    std::string key;    ///< as written; compared without regard to case
    std::string value;  ///< without braces
    int line = 0;
};

class Header {
  public:
    /// Throws InputError naming file and line.
    static Header parse(std::string_view text, const std::filesystem::path& file);

    [[nodiscard]] const std::vector<Field>& fields() const { return fields_; }
    [[nodiscard]] const Field* find(std::string_view key) const;
    [[nodiscard]] SourceLocation where(const Field& field) const { return {file_, field.line}; }
    /// An integer from `least` to `most`; `otherwise` where the key is missing, and an InputError without
    /// that.
    [[nodiscard]] long long integer(std::string_view key, long long least, long long most,
                                    std::optional<long long> otherwise = {}) const;
    [[nodiscard]] std::optional<double> number(std::string_view key) const;
    /// A list of `count` numbers, or an empty one where the key is missing.
    [[nodiscard]] std::vector<double> numbers(std::string_view key, size_t count) const;

  private:
    std::string file_;
    std::vector<Field> fields_;
};

/// The whole header of a cube in BIL order, float32.
[[nodiscard]] std::string headerText(const CubeInfo& info, const std::filesystem::path& file);

/// Wavelengths in nm in the order of the file's bands, all above 0.
[[nodiscard]] std::vector<double> wavelengthsNm(const Header& header, size_t bands, Notes& notes);

/// Text as printable ASCII without braces: everything else, and %, as %XX. And back.
[[nodiscard]] std::string encoded(std::string_view text);
[[nodiscard]] std::string decoded(std::string_view text);

}  // namespace envi

}  // namespace spectrad
