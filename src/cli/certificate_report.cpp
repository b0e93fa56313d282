#include "cli/certificate_report.h"

#include "base/files.h"
#include "base/text.h"
#include "cli/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace spectrad {

namespace {

std::string within(const Estimate& e) {
    return fmt::format("{} ({} to {})", rounded(e.value, 3), e.low ? rounded(*e.low, 3) : "0",
                       e.high ? rounded(*e.high, 3) : "unknown");
}

Json described(const Estimate& e) {
    return {{"value", e.value}, {"low", orNull(e.low)}, {"high", orNull(e.high)}};
}

Json described(const Estimates& of) {
    return {{"mean", described(of.mean)},
            {"p95", described(of.p95)},
            {"p99", described(of.p99)},
            {"max", {{"found", of.largest}, {"share_beyond_at_most", of.shareBeyond}}}};
}

struct Source {
    std::string name, digest;
};
std::vector<Source> readSources(const std::string& text) {
    std::vector<Source> sources;
    for (std::string_view entry : split(text, ',')) {
        const size_t blank = entry.rfind(' ');
        if (blank == std::string_view::npos) continue;
        sources.push_back({std::string(entry.substr(0, blank)), std::string(entry.substr(blank + 1))});
    }
    return sources;
}

}  // namespace

double parseShare(const std::string& option, const std::string& text) {
    std::string_view number = text;
    if (!number.empty() && number.back() == '%') number.remove_suffix(1);
    const std::optional<double> value = parseDouble(number);
    if (!value || !(*value > 0) || *value > 100)
        throw UsageError(option + ": '" + text + "' is not a share of the pixels, such as 1%");
    return *value / 100;
}

std::uint64_t parseSeed(const std::string& text) {
    const std::optional<long long> seed = parseInteger(text);
    if (!seed || *seed < 0) throw UsageError("--seed: '" + text + "' is not a whole number from 0 on");
    return static_cast<std::uint64_t>(*seed);
}

std::string inWords(const Certificate& c) {
    return fmt::format(
        "certificate         {} of {} pixels (seed {}) against the reference; intervals at {} % confidence\n"
        "CIEDE2000           mean {}, 95 % {}, 99 % {}, largest found {} at {},{} (white {} at Y = {}, {})\n"
        "                    at most {} % of the pixels are beyond the largest found\n"
        "band error          mean {} %, 99 % {} %, largest found {} % of the band's largest value\n"
        "pixels' whole area  {} of them with {} samples: CIEDE2000 mean {}, 99 % {}; band error 99 % {} %\n",
        c.pixels, c.population, c.seed, shortest(100 * certificateConfidence), within(c.colour.mean),
        within(c.colour.p95), within(c.colour.p99), rounded(c.colour.largest, 3), c.worst.x, c.worst.y,
        c.white.name, rounded(c.white.xyz[1], 5), c.observer, rounded(100 * c.colour.shareBeyond, 2),
        rounded(100 * c.bands.mean.value, 3), rounded(100 * c.bands.p99.value, 3),
        rounded(100 * c.bands.largest, 3), c.areaPixels, areaSamples, within(c.areaColour.mean),
        within(c.areaColour.p99), rounded(100 * c.areaBands.p99.value, 3));
}

Json described(const Certificate& c) {
    return {{"observer", c.observer},
            {"white", {{"name", c.white.name}, {"XYZ", c.white.xyz}}},
            {"seed", c.seed},
            {"pixels", c.pixels},
            {"of", c.population},
            {"confidence", certificateConfidence},
            {"deltae00", described(c.colour)},
            {"max_at", {c.worst.x, c.worst.y}},
            {"band_relative", described(c.bands)},
            {"area",
             {{"pixels", c.areaPixels},
              {"samples", areaSamples},
              {"deltae00", described(c.areaColour)},
              {"band_relative", described(c.areaBands)}}},
            {"taken_over", c.taken}};
}

std::map<std::string, std::string> attributesOf(const Certificate& c) {
    const Triple& w = c.white.xyz;
    return {{"verifyPixels", fmt::format("{} of {}, seed {}", c.pixels, c.population, c.seed)},
            {"verifyConfidence", shortest(certificateConfidence)},
            {"verifyObserver", c.observer},
            {"verifyWhite", fmt::format("{}, {},{},{} cd/m2", c.white.name, rounded(w[0], 7),
                                        rounded(w[1], 7), rounded(w[2], 7))},
            {"verifyDeltaE00Mean", within(c.colour.mean)},
            {"verifyDeltaE00P95", within(c.colour.p95)},
            {"verifyDeltaE00P99", within(c.colour.p99)},
            {"verifyDeltaE00Max",
             fmt::format("{} found at {},{}; at most {} % of the pixels beyond", rounded(c.colour.largest, 3),
                         c.worst.x, c.worst.y, rounded(100 * c.colour.shareBeyond, 2))},
            {"verifyBandError", fmt::format("mean {}, 99 % {}, {} found", within(c.bands.mean),
                                            within(c.bands.p99), rounded(c.bands.largest, 3))},
            {"verifyArea",
             fmt::format("{} of these pixels with {} samples: CIEDE2000 mean {}, 99 % {}; band error 99 % {}",
                         c.areaPixels, areaSamples, within(c.areaColour.mean), within(c.areaColour.p99),
                         within(c.areaBands.p99))}};
}

namespace {

std::string reachedOf(const Chosen& chosen, const Tolerance& tolerance) {
    return tolerance.radiance ? rounded(100 * chosen.reached, 3) + " %" : rounded(chosen.reached, 3);
}

}  // namespace

std::string inWords(const Chosen& chosen, const std::string& asked) {
    const Tolerance tolerance = parseTolerance(asked);
    std::string text = fmt::format("tolerance           {}: {} {}, tried at {} x {} pixels\n",
                                   tolerance.words(), chosen.met ? "reached" : "not met, reached",
                                   reachedOf(chosen, tolerance), chosen.width, chosen.height);
    for (const Choice& choice : chosen.choices)
        text += fmt::format("  {:<17} {}\n", choice.what, choice.why);
    return text;
}

Json described(const Chosen& chosen, const Certificate& certificate, const std::string& asked) {
    const Verdict verdict = judged(certificate, parseTolerance(asked));
    Json choices = Json::array();
    for (const Choice& choice : chosen.choices)
        choices.push_back({{"choice", choice.what}, {"why", choice.why}});
    Json out{{"asked", asked},
             {"met", chosen.met && verdict != Verdict::refuted},
             {"reached", chosen.reached},
             {"verdict", name(verdict)},
             {"observer", certificate.observer}};
    if (!parseTolerance(asked).radiance)
        out["white"] = {{"name", chosen.white.name}, {"XYZ", chosen.white.xyz}};
    out.update({{"tried_at", {chosen.width, chosen.height}},
                {"half", chosen.half},
                {"schlick", chosen.schlick},
                {"choices", choices}});
    return out;
}

std::map<std::string, std::string> attributesOf(const Chosen& chosen, const std::string& asked) {
    std::string choices;
    for (const Choice& choice : chosen.choices)
        choices += fmt::format("{}{} ({})", choices.empty() ? "" : "; ", choice.what, choice.why);
    return {{"tolerance", fmt::format("{}: {} {}", parseTolerance(asked).words(),
                                      chosen.met ? "reached" : "not met, reached",
                                      reachedOf(chosen, parseTolerance(asked)))},
            {"toleranceChoices", choices}};
}

ExitCode toleranceVerdict(const Chosen& chosen, const Certificate& certificate, const std::string& asked) {
    const Tolerance tolerance = parseTolerance(asked);
    if (!chosen.met)
        printError(
            fmt::format("no settings keep {}: reached {}", tolerance.words(), reachedOf(chosen, tolerance)));
    else if (judged(certificate, tolerance) == Verdict::refuted)
        printError(fmt::format("the certificate refutes {}", tolerance.words()));
    else
        return ExitCode::ok;
    return ExitCode::input;
}

std::string sourcesOf(const Scene& scene) {
    std::string text;
    for (const std::string& file : scene.filesRead)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ",
                            std::filesystem::path(file).filename().string(), sha256(readFile(file)));
    return text;
}

std::vector<std::string> changedSince(const std::string& text, const Scene& scene) {
    const std::vector<Source> then = readSources(text), now = readSources(sourcesOf(scene));
    std::vector<std::string> changed;
    for (size_t i = 0; i < std::max(then.size(), now.size()); ++i) {
        if (i < then.size() && i < now.size() && then[i].digest == now[i].digest) continue;
        if (i >= then.size())
            changed.push_back("'" + now[i].name + "' is read, which was not then");
        else if (i < now.size() && (i == 0 || then[i].name == now[i].name))
            changed.push_back("'" + now[i].name + "' has changed");
        else
            changed.push_back("'" + then[i].name + "' is not read any more, or in another order");
    }
    return changed;
}

}  // namespace spectrad
