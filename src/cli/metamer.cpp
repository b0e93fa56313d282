// spectrad metamer: reflectances that match here and differ there, and how far two of them are apart.
#include "base/files.h"
#include "base/text.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/options.h"
#include "metamer/metamers.h"
#include "spectrum/detector_product.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace spectrad {

namespace {

struct MetamerArguments {
    std::string reflectance, other, output, wavelengths = "380:780:5", bounds = "0:1", smoothness = "1",
                                            count = "5";
    std::vector<std::string> match, differ;
    bool json = false, quiet = false;
};

/// What every viewing needs.
struct Eyes {
    explicit Eyes(Notes& notes)
        : library(Library::open()),
          resolver(library, ".", false, notes),
          standard(standardObserver(library)) {}

    /// "LIGHT" or "LIGHT,OBSERVER"; CIE 1931 where none is named.
    [[nodiscard]] Viewing viewing(const char* option, const std::string& text) const {
        const size_t comma = text.find(',');
        const std::string light(trimmed(text.substr(0, comma)));
        if (light.empty())
            throw UsageError(fmt::format("{}: '{}' names no light (LIGHT or LIGHT,OBSERVER)", option, text));
        const Detector detector =
            comma == std::string::npos
                ? standard
                : detectorFor(std::string(trimmed(text.substr(comma + 1))), resolver, {});
        return {text, resolver.resolve(light, Role::light, {}).curve(), detector, standard};
    }
    [[nodiscard]] std::vector<Viewing> viewings(const char* option, const std::vector<std::string>& texts,
                                                const std::vector<std::string>& otherwise) const {
        std::vector<Viewing> result;
        for (const std::string& text : texts.empty() ? otherwise : texts)
            result.push_back(viewing(option, text));
        return result;
    }
    [[nodiscard]] Curve reflectance(const std::string& text) const {
        return resolver.resolve(text, Role::reflectance, {}).curve();
    }

    Library library;
    SpectrumResolver resolver;
    Detector standard;
};

MetamerSettings settingsOf(const MetamerArguments& arguments) {
    MetamerSettings settings;
    settings.nm = asUsage("--wavelengths", [&] { return parseWavelengths(arguments.wavelengths, {}).nm; });
    const std::vector<std::string_view> ends = split(arguments.bounds, ':');
    if (ends.size() != 2) throw UsageError("--bounds: '" + arguments.bounds + "' is not LOW:HIGH");
    settings.low = parseNumber("--bounds", ends[0], 0, 1);
    settings.high = parseNumber("--bounds", ends[1], 0, 1);
    if (settings.low >= settings.high)
        throw UsageError("--bounds: '" + arguments.bounds + "' is not LOW:HIGH, LOW below HIGH");
    settings.smoothness = parseNumber("--smoothness", arguments.smoothness, 1e-6, 1e6);
    settings.count = parseCount("--count", arguments.count, 1, 1000);
    if (settings.nm.size() < 4)
        throw UsageError("--wavelengths: a smooth reflectance wants four of them at least");
    return settings;
}

/// The lamp of the library under which two reflectances differ most, for CIE 1931.
struct WorstLamp {
    std::string name;
    double deltaE = 0;
};

WorstLamp worstLamp(const Eyes& eyes, const Curve& a, const Curve& b) {
    WorstLamp worst;
    for (const LibraryEntry& entry : eyes.library.list()) {
        const bool lamp = entry.name.starts_with("illuminants/") || entry.name.starts_with("lamps/");
        if (!lamp || entry.channels.size() != 1) continue;
        try {
            const double e = difference(eyes.viewing("lamp", entry.name), a, b);
            if (e > worst.deltaE) worst = {entry.name, e};
        } catch (const InputError&) {
            // A lamp without one of X, Y, Z has no white to compare against.
        }
    }
    return worst;
}

void writeTable(const MetamerArguments& arguments, const std::vector<double>& nm, const Curve& original,
                const std::vector<Metamer>& metamers) {
    std::string text = fmt::format(
        "# title: metamers of {}\n# quantity: reflectance\n# unit: 1\n# source: spectrad metamer\n"
        "wavelength_nm,original",
        arguments.reflectance);
    for (size_t k = 0; k < metamers.size(); ++k)
        text += fmt::format(",metamer{}", k + 1);
    text += '\n';
    for (size_t j = 0; j < nm.size(); ++j) {
        text += shortest(nm[j]) + "," + rounded(original.at(nm[j]), 10);
        for (const Metamer& metamer : metamers)
            text += "," + rounded(metamer.value[j], 10);
        text += '\n';
    }
    writeFile(arguments.output, text);
}

Json differences(const std::vector<Viewing>& viewings, const std::vector<double>& values) {
    Json out = Json::array();
    for (size_t i = 0; i < viewings.size(); ++i)
        out.push_back({{"viewing", viewings[i].name()}, {"deltae00", values[i]}});
    return out;
}

ExitCode make(const MetamerArguments& arguments, const Eyes& eyes, const std::vector<Viewing>& match,
              const std::vector<Viewing>& differ, Console& console) {
    const MetamerSettings settings = settingsOf(arguments);
    if (!arguments.output.empty()) requireWritable(arguments.output);
    const Curve original = eyes.reflectance(arguments.reflectance);
    const std::vector<Metamer> metamers = makeMetamers(original, match, differ, settings);
    console.printNotes();
    if (!arguments.output.empty()) writeTable(arguments, settings.nm, original, metamers);
    Json out{
        {"reflectance", arguments.reflectance}, {"wavelengths_nm", settings.nm}, {"metamers", Json::array()}};
    std::string text;
    for (size_t k = 0; k < metamers.size(); ++k) {
        const WorstLamp worst = worstLamp(eyes, original, metamers[k].curve(settings.nm));
        out["metamers"].push_back({{"reflectance", metamers[k].value},
                                   {"match", differences(match, metamers[k].matched)},
                                   {"differ", differences(differ, metamers[k].differing)},
                                   {"worst_lamp", {{"name", worst.name}, {"deltae00", worst.deltaE}}}});
        text += fmt::format("metamer{}", k + 1);
        for (size_t i = 0; i < match.size(); ++i)
            text += fmt::format("  {} {:.5f}", match[i].name(), metamers[k].matched[i]);
        for (size_t i = 0; i < differ.size(); ++i)
            text += fmt::format("  {} {:.3f}", differ[i].name(), metamers[k].differing[i]);
        text += fmt::format("  worst lamp {} {:.3f}\n", worst.name, worst.deltaE);
    }
    if (arguments.json)
        printJson(out);
    else
        printText(
            "# CIEDE2000 to the original: viewings to match, viewings to differ, the library's lamp that "
            "breaks it worst\n" +
            text);
    return ExitCode::ok;
}

/// Indices of a pair, for each viewing to match as the reference and each to differ as the test.
ExitCode judge(const MetamerArguments& arguments, const Eyes& eyes, const std::vector<Viewing>& match,
               const std::vector<Viewing>& differ, Console& console) {
    const Curve a = eyes.reflectance(arguments.reflectance), b = eyes.reflectance(arguments.other);
    const WorstLamp worst = worstLamp(eyes, a, b);
    console.printNotes();
    Json out{{"a", arguments.reflectance},
             {"b", arguments.other},
             {"worst_lamp", {{"name", worst.name}, {"deltae00", worst.deltaE}}},
             {"indices", Json::array()}};
    std::string text;
    for (const Viewing& reference : match) {
        text += fmt::format("under {}: CIEDE2000 {:.4f}\n", reference.name(), difference(reference, a, b));
        for (const Viewing& test : differ) {
            const MetamerismIndex index = specialMetamerismIndex(reference, test, a, b);
            out["indices"].push_back({{"reference", reference.name()},
                                      {"reference_deltae00", difference(reference, a, b)},
                                      {"test", test.name()},
                                      {"deltae76", index.deltaE76},
                                      {"deltae00", index.deltaE00}});
            text +=
                fmt::format("  special metamerism index under {}: {:.4f} (CIE 1976), {:.4f} (CIEDE2000)\n",
                            test.name(), index.deltaE76, index.deltaE00);
        }
    }
    if (arguments.json)
        printJson(out);
    else
        printText(text + fmt::format("the library's lamp that breaks it worst: {}, CIEDE2000 {:.4f}\n",
                                     worst.name, worst.deltaE));
    return ExitCode::ok;
}

ExitCode metamer(const MetamerArguments& arguments) {
    Console console(arguments.quiet);
    const Eyes eyes(console.notes());
    const std::vector<Viewing> match = eyes.viewings("--match", arguments.match, {"illuminants/D65"});
    const std::vector<Viewing> differ = eyes.viewings("--differ", arguments.differ, {"illuminants/A"});
    return arguments.other.empty() ? make(arguments, eyes, match, differ, console)
                                   : judge(arguments, eyes, match, differ, console);
}

}  // namespace

void addMetamer(CLI::App& app, Action& action) {
    CLI::App* command =
        app.add_subcommand("metamer", "Make reflectances that match here and differ there, or judge a pair");
    auto arguments = std::make_shared<MetamerArguments>();
    command->add_option("REFLECTANCE", arguments->reflectance, "a reflectance: name, file or formula")
        ->required();
    CLI::Option* other = command->add_option(
        "OTHER", arguments->other, "another: print metamerism indices of the two instead of making any");
    command
        ->add_option(
            "--match", arguments->match,
            "a viewing under which to match, may be repeated; the observer is CIE 1931 if not said; default: "
            "illuminants/D65")
        ->type_name("LIGHT[,OBSERVER]");
    command
        ->add_option("--differ", arguments->differ,
                     "a viewing under which to differ, may be repeated; default: illuminants/A")
        ->type_name("LIGHT[,OBSERVER]");
    command->add_option("--count", arguments->count, "how many, spread over directions of colour; default: 5")
        ->type_name("N");
    command
        ->add_option(
            "--smoothness", arguments->smoothness,
            "weight of the squared second derivative; larger is smoother and differs less; default: 1")
        ->type_name("S");
    command->add_option("--bounds", arguments->bounds, "reflectances allowed; default: 0:1")
        ->type_name("LOW:HIGH");
    command
        ->add_option("--wavelengths", arguments->wavelengths,
                     "nodes in nm, linear between; default: 380:780:5")
        ->type_name("FROM:TO:STEP");
    command
        ->add_option("-o,--output", arguments->output,
                     "write original and metamers as a table that scenes read")
        ->type_name("OUT.csv");
    // What says how to make metamers says nothing of a pair.
    for (const char* option : {"--count", "--smoothness", "--bounds", "--wavelengths", "-o"})
        command->get_option(option)->excludes(other);
    command->add_flag("--json", arguments->json, "print a JSON object");
    command->add_flag("-q,--quiet", arguments->quiet, "no remarks on standard error");
    command->footer(
        "Indices of a pair are the CIE's special metamerism index (CIE 015:2018: change in illuminant; the "
        "same for a change of "
        "observer), with the difference left under the reference taken out in proportion.\n\n"
        "Examples:\n"
        "  spectrad metamer charts/colorchecker/foliage -o foliage.csv\n"
        "  spectrad metamer paint.csv --match illuminants/D65 --match illuminants/A --differ "
        "illuminants/FL11\n"
        "  spectrad metamer paint.csv --differ illuminants/D65,nikon-5100 --smoothness 10\n"
        "  spectrad metamer paint.csv ink.csv --differ illuminants/A --differ illuminants/D65,cie1964-10");
    command->final_callback([&action, arguments] { action = [arguments] { return metamer(*arguments); }; });
}

}  // namespace spectrad
