#include "verify/tolerance.h"

#include "base/text.h"

#include <fmt/format.h>

namespace spectrad {

std::string Tolerance::words() const {
    const std::string what = radiance ? "band error" : "CIEDE2000";
    return fmt::format("{} of {} pixels within {}", what, all ? "all" : "99 % of the",
                       radiance ? rounded(100 * bound, 12) + " %" : shortest(bound));
}

Tolerance parseTolerance(std::string_view text) {
    Tolerance t;
    std::string_view rest = text;
    if (startsWith(rest, "max:")) {
        t.all = true;
        rest.remove_prefix(4);
    }
    if (rest.size() > 4 && rest.substr(rest.size() - 4) == "%rad") {
        t.radiance = true;
        rest.remove_suffix(4);
    }
    const std::optional<double> value = parseDouble(rest);
    if (!value || !(*value > 0))
        throw UsageError(fmt::format(
            "'{}' is no tolerance: 0.5 (CIEDE2000 of 99 % of the pixels), max:0.5 (of all), 1%rad "
            "(bands' radiance) or max:1%rad",
            text));
    t.bound = t.radiance ? *value / 100 : *value;
    return t;
}

Verdict judged(const Certificate& certificate, const Tolerance& tolerance) {
    const Estimates& of = tolerance.radiance ? certificate.bands : certificate.colour;
    if (tolerance.all) {
        if (of.largest > tolerance.bound) return Verdict::refuted;
        return certificate.pixels == certificate.population ? Verdict::proven : Verdict::open;
    }
    if (of.p99.low && *of.p99.low > tolerance.bound) return Verdict::refuted;
    return of.p99.high && *of.p99.high <= tolerance.bound ? Verdict::proven : Verdict::open;
}

std::string_view name(Verdict verdict) {
    switch (verdict) {
        case Verdict::proven:
            return "proven";
        case Verdict::open:
            return "open";
        case Verdict::refuted:
            break;
    }
    return "refuted";
}

}  // namespace spectrad
