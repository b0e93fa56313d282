// <spectrum>: a name for a value, for a table in the scene, or for a file.
#include "base/text.h"
#include "scene/reading.h"
#include "spectrum/readers/reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>

namespace spectrad {

namespace {

Role roleOf(Quantity quantity) {
    switch (quantity) {
        case Quantity::reflectance:
            return Role::reflectance;
        case Quantity::transmittance:
            return Role::transmittance;
        case Quantity::radiance:
        case Quantity::irradiance:
        case Quantity::intensity:
        case Quantity::power:
            return Role::light;
        case Quantity::sensitivity:
            return Role::detector;
        case Quantity::index:
            return Role::index;
        default:
            return Role::any;
    }
}

/// Pairs "400:0.1 500:0.2" or two columns, from the element's body.
Spectrum readBody(const Element& element, const std::string& body) {
    const SourceLocation where = element.whereBody();
    // As many empty lines in front as the scene has: errors then name the scene's own line.
    const bool pairs = body.find(':') != std::string::npos;
    const SpectrumTable table =
        pairs ? readPairs(body, where)
              : readColumns(std::string(static_cast<size_t>(where.line - 1), '\n') + body, where.file);
    if (table.columns.size() != 1)
        element.fail(
            fmt::format("holds {} columns (expected two, wavelength in nm and value, or pairs as in 400:0.1)",
                        table.columns.size() + 1));
    Spectrum spectrum;
    spectrum.channels = {"value"};
    spectrum.curves = {Curve::table(table.nm, table.columns.front())};
    return spectrum;
}

/// The quantity that the element states; unknown if it states none.
Quantity statedQuantity(const Element& element) {
    return element.has("quantity") ? parseQuantity(element.text("quantity"), element.where("quantity"))
                                   : Quantity::unknown;
}

/// What the element states must be what the data are, where they say so themselves. A relative lamp has a
/// shape only: it may stand for any quantity of light.
void stateQuantity(const Element& element, Spectrum& spectrum, Quantity stated) {
    if (stated == Quantity::unknown) return;
    const bool lampShape =
        spectrum.relative && roleOf(stated) == Role::light && roleOf(spectrum.quantity) == Role::light;
    if (spectrum.quantity != Quantity::unknown && spectrum.quantity != stated && !lampShape)
        element.fail("quantity", fmt::format("the data are of quantity {}", name(spectrum.quantity)));
    spectrum.quantity = stated;
}

/// Measured shares are noisy: what lies up to `noise` outside 0…1 is set to the limit, and said; what lies
/// farther outside is refused by whoever checks the role.
void settleNoise(Spectrum& spectrum, double noise, const SourceLocation& where, Notes& notes) {
    size_t settled = 0, all = 0;
    double most = 0;
    for (Curve& curve : spectrum.curves) {
        const std::span<const double> nm = curve.sampleWavelengths();
        if (nm.empty()) continue;
        std::vector<double> values(curve.sampleValues().begin(), curve.sampleValues().end());
        for (double& value : values) {
            ++all;
            const double limit = std::clamp(value, 0.0, 1.0), beyond = std::abs(value - limit);
            if (beyond == 0 || beyond > noise) continue;
            ++settled;
            most = std::max(most, beyond);
            value = limit;
        }
        curve = Curve::table({nm.begin(), nm.end()}, std::move(values), curve.outside());
    }
    if (settled > 0)
        notes.say(fmt::format("{}: {} of {} values lie outside 0 … 1, by up to {}: set to the limit (noise)",
                              where.str(), settled, all, rounded(most, 3)));
}

void readSpectrum(Reading& reading, const Element& element) {
    const std::string body = element.body();
    const bool hasBody = !trimmed(body).empty();
    const int ways = int(element.has("value")) + int(element.has("file")) + int(hasBody);
    if (ways != 1)
        element.fail(ways == 0 ? "has no data (allowed: value=, file=, or pairs or two columns in its body)"
                               : "has its data twice (allowed: one of value=, file=, body)");
    if (!element.has("file")) element.refuse("column", "stands only beside 'file'");

    const Quantity stated = statedQuantity(element);
    const Role role = roleOf(stated);
    const bool noisy = element.has("noise");
    if (noisy && role != Role::reflectance && role != Role::transmittance)
        element.fail("noise",
                     "is of a share of light (allowed beside quantity=\"reflectance\" or \"transmittance\")");
    const Role found = noisy ? Role::any : role;  // judged below
    Spectrum spectrum;
    if (element.has("value")) {
        spectrum = reading.resolver.resolve(element.text("value"), found, element.where("value"));
    } else if (hasBody) {
        spectrum = readBody(element, body);
        spectrum.text = element.text("name");
    } else {
        spectrum = reading.resolver.resolveFile(element.text("file"), element.text("column"), found,
                                                element.where("file"));
    }
    for (const std::filesystem::path& file : spectrum.files)
        reading.files.add(file);
    stateQuantity(element, spectrum, stated);
    spectrum.relative = element.boolean("relative", spectrum.relative);
    if (noisy) settleNoise(spectrum, element.number("noise", 0, zeroToOne), element.where(), reading.notes);
    spectrum = reading.resolver.checked(std::move(spectrum), role, element.where());
    reading.resolver.define(element.text("name"), std::move(spectrum), element.where());
}

}  // namespace

void readSpectra(Reading& reading) {
    enum class State { waiting, open, done };
    struct Entry {
        Element element;
        State state = State::waiting;
    };
    std::vector<Entry> entries;
    std::unordered_map<std::string, size_t> byName;
    for (const pugi::xml_node node : reading.document.root().children("spectrum")) {
        entries.push_back({Element(reading.document, node)});
        byName.try_emplace(entries.back().element.text("name"),
                           entries.size() - 1);  // a second one: define() refuses it
    }

    // value="other" wants the other first: follow the names to one that waits for none, then come back.
    for (size_t first = 0; first < entries.size(); ++first) {
        std::vector<size_t> chain;
        for (size_t at = first; entries[at].state == State::waiting;) {
            entries[at].state = State::open;
            chain.push_back(at);
            const auto wanted = byName.find(entries[at].element.text("value"));
            if (wanted == byName.end() || wanted->second == at) break;
            at = wanted->second;
            if (entries[at].state == State::open) {
                std::vector<std::string> names;
                names.reserve(chain.size() + 1);
                for (const size_t link : chain)
                    names.push_back(entries[link].element.text("name"));
                names.push_back(entries[at].element.text("name"));
                entries[first].element.fail(
                    fmt::format("defines itself by itself: {}", fmt::join(names, " -> ")));
            }
        }
        for (; !chain.empty(); chain.pop_back()) {
            readSpectrum(reading, entries[chain.back()].element);
            entries[chain.back()].state = State::done;
        }
    }
}

}  // namespace spectrad
