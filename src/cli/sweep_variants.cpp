#include "cli/sweep_variants.h"

#include "base/limits.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

namespace spectrad {

SweepAxis parseAxis(const std::string& text) {
    const size_t equals = text.find('=');
    SweepAxis axis;
    if (equals != std::string::npos) {
        for (const std::string_view attribute : split(std::string_view(text).substr(0, equals), '+'))
            axis.attributes.emplace_back(attribute);
        for (const std::string_view value : split(std::string_view(text).substr(equals + 1), '|'))
            axis.values.emplace_back(value);
    }
    const auto empty = [](const std::string& s) { return s.empty(); };
    if (equals == std::string::npos || std::any_of(axis.attributes.begin(), axis.attributes.end(), empty) ||
        std::any_of(axis.values.begin(), axis.values.end(), empty))
        throw UsageError("--vary: '" + text +
                         "' is not NODE.ATTR[+NODE.ATTR]=VALUE|VALUE…, as in "
                         "key.spectrum+fill.spectrum=illuminants/A|illuminants/D65");
    return axis;
}

Region parseRegion(const std::string& text) {
    const size_t equals = text.find('=');
    std::vector<long long> numbers;
    if (equals != std::string::npos)
        for (const std::string_view piece : split(std::string_view(text).substr(equals + 1), ','))
            numbers.push_back(parseInteger(piece).value_or(-1));
    if (numbers.size() != 4 || *std::min_element(numbers.begin(), numbers.end()) < 0 || numbers[2] == 0 ||
        numbers[3] == 0 || *std::max_element(numbers.begin(), numbers.end()) > largestSide || equals == 0)
        throw UsageError("--region: '" + text + "' is not NAME=X,Y,WIDTH,HEIGHT in pixels, (0,0) top left");
    Region region;
    region.name = text.substr(0, equals);
    region.rect = {static_cast<int>(numbers[0]), static_cast<int>(numbers[1]), static_cast<int>(numbers[2]),
                   static_cast<int>(numbers[3])};
    return region;
}

std::string fileName(std::string text) {
    std::replace_if(
        text.begin(), text.end(),
        [](char c) { return !(std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-'); }, '_');
    return text;
}

std::vector<std::string> distinct(std::vector<std::string> names) {
    std::set<std::string> taken(names.begin(), names.end()), seen;
    std::map<std::string, int> count;
    for (std::string& name : names) {
        int& number = count[name];
        ++number;
        if (seen.insert(name).second) continue;
        std::string numbered = fmt::format("{}-{}", name, number);
        while (!taken.insert(numbered).second)
            numbered = fmt::format("{}-{}", name, ++number);
        name = std::move(numbered);
    }
    return names;
}

std::vector<SweepVariant> variantsOf(const std::vector<SweepAxis>& axes) {
    constexpr size_t most = 10'000;
    std::vector<SweepVariant> variants(1);
    for (const SweepAxis& axis : axes) {
        if (variants.size() * axis.values.size() > most)
            throw InputError(axis.where, fmt::format("a sweep of more than {} variants (the limit)", most));
        std::vector<SweepVariant> next;
        for (const SweepVariant& before : variants)
            for (const std::string& value : axis.values) {
                SweepVariant variant = before;
                if (!variant.name.empty()) variant.name += '-';
                variant.name += fileName(value);
                for (const std::string& attribute : axis.attributes)
                    variant.set.push_back(attribute + "=" + value);
                variant.where = axis.where;
                next.push_back(std::move(variant));
            }
        variants = std::move(next);
    }
    std::vector<std::string> plain;
    for (const SweepVariant& variant : variants)
        plain.push_back(variant.name.empty() ? "scene" : variant.name);
    const std::vector<std::string> names = distinct(plain);
    for (size_t i = 0; i < variants.size(); ++i) {
        variants[i].name = names[i];
        variants[i].numbered = names[i] != plain[i];
    }
    return variants;
}

const Sweep* chooseSweep(const Scene& scene, const std::string& name) {
    std::vector<std::string> names;
    for (const Sweep& sweep : scene.sweeps) {
        if (sweep.name == name) return &sweep;
        names.push_back(sweep.name);
    }
    if (name.empty() && names.size() < 2) return names.empty() ? nullptr : scene.sweeps.data();
    if (name.empty())
        throw UsageError(
            fmt::format("the scene has several sweeps: say --sweep NAME ({})", fmt::join(names, ", ")));
    throw UsageError(fmt::format("--sweep: the scene has no <sweep name=\"{}\">{} (there are: {})", name,
                                 didYouMean(name, names),
                                 names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

}  // namespace spectrad
