#include "scene/amounts.h"

#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <vector>

namespace spectrad {

namespace {

struct UnitName {
    std::string_view text;
    AmountUnit unit;
    std::string_view attribute;  ///< what it is a unit of
};
constexpr std::array units{
    UnitName{"cd", AmountUnit::candela, "intensity"},
    UnitName{"W/sr", AmountUnit::wattPerSteradian, "intensity"},
    UnitName{"lm", AmountUnit::lumen, "power"},
    UnitName{"W", AmountUnit::watt, "power"},
    UnitName{"lx", AmountUnit::lux, "illuminance"},
    UnitName{"W/m2", AmountUnit::wattPerSquareMetre, "irradiance"},
    UnitName{"cd/m2", AmountUnit::candelaPerSquareMetre, "luminance"},
    UnitName{"W/m2/sr", AmountUnit::wattPerSquareMetreSteradian, "radiance"},
};

std::string allowedUnits(std::string_view attribute) {
    std::vector<std::string_view> allowed;
    for (const UnitName& unit : units)
        if (unit.attribute == attribute) allowed.push_back(unit.text);
    return fmt::format("{}", fmt::join(allowed, ", "));
}

/// "W/m²" is "W/m2".
std::string withPlainExponents(std::string_view text) {
    static constexpr std::string_view squared = "\xC2\xB2";
    std::string result;
    for (size_t at = text.find(squared); at != std::string_view::npos; at = text.find(squared)) {
        result.append(text.substr(0, at));
        result.push_back('2');
        text.remove_prefix(at + squared.size());
    }
    return result.append(text);
}

std::optional<std::pair<double, double>> parseRange(std::string_view text) {
    const auto ends = split(text, ':');
    if (ends.size() != 2) return std::nullopt;
    const auto from = parseDouble(ends[0]), to = parseDouble(ends[1]);
    if (!from || !to || !(*from > 0) || !(*to > *from)) return std::nullopt;
    return std::pair{*from, *to};
}

}  // namespace

bool isPhotometric(AmountUnit unit) {
    return unit == AmountUnit::candela || unit == AmountUnit::lumen || unit == AmountUnit::lux ||
           unit == AmountUnit::candelaPerSquareMetre;
}

std::span<const std::string_view> amountAttributes() {
    static constexpr std::array<std::string_view, 6> names{"intensity",  "power",     "illuminance",
                                                           "irradiance", "luminance", "radiance"};
    return names;
}

std::optional<Amount> parseAmount(std::string_view attribute, std::string_view text, std::string& complaint) {
    const auto pieces = words(text);
    const std::string allowed = allowedUnits(attribute);
    const auto value = pieces.empty() ? std::nullopt : parseDouble(pieces[0]);
    if (!value || *value < 0) {
        complaint = fmt::format(
            "expected a number of at least 0 and a unit with a blank between (allowed units: {})", allowed);
        return std::nullopt;
    }
    if (pieces.size() < 2 || pieces[1] == "over") {
        complaint = fmt::format("the unit is missing (allowed: {})", allowed);
        return std::nullopt;
    }
    Amount amount;
    amount.value = *value;
    const std::string unitText = withPlainExponents(pieces[1]);
    const UnitName* unit = nullptr;
    for (const UnitName& known : units)
        if (known.text == unitText) unit = &known;
    if (!unit || unit->attribute != attribute) {
        complaint =
            unit ? fmt::format("'{}' is a unit of {} (allowed: {})", pieces[1], unit->attribute, allowed)
                 : fmt::format("unknown unit '{}' (allowed: {})", pieces[1], allowed);
        return std::nullopt;
    }
    amount.unit = unit->unit;
    if (pieces.size() == 2) return amount;
    if (pieces.size() != 4 || pieces[2] != "over" || !(amount.over = parseRange(pieces[3]))) {
        complaint = "after the unit only a range in nm may follow, as in 'over 400:700'";
        return std::nullopt;
    }
    if (isPhotometric(amount.unit)) {
        complaint = fmt::format("'over' is for radiometric amounts; {} counts what the eye sees", unit->text);
        return std::nullopt;
    }
    return amount;
}

}  // namespace spectrad
