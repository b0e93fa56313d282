// A source's spectrum and amount (docs/format.md, "Amounts").
#include "base/text.h"
#include "scene/amounts.h"
#include "scene/reading.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace spectrad {

namespace {

struct KindOfSource {
    std::array<std::string_view, 2> amounts;  ///< attributes that may state its amount
    Quantity own;                             ///< what an absolute spectrum must be
};

const KindOfSource& kindOfSource(SourceKind kind) {
    static const std::array<KindOfSource, 3> kinds{
        KindOfSource{{"intensity", "power"}, Quantity::intensity},
        KindOfSource{{"illuminance", "irradiance"}, Quantity::irradiance},
        KindOfSource{{"luminance", "radiance"}, Quantity::radiance}};
    return kinds[static_cast<size_t>(kind)];
}

std::string waysToSayIt(const KindOfSource& kind) {
    return fmt::format("allowed: {}=, scale=, or an absolute spectrum of quantity=\"{}\"",
                       fmt::join(kind.amounts, "=, "), name(kind.own));
}

/// The one amount attribute of the element; nothing if there is none.
std::optional<std::string> amountAttribute(const Element& element, const KindOfSource& kind,
                                           const std::string& what) {
    std::optional<std::string> found;
    for (std::string_view attribute : amountAttributes()) {
        const std::string key(attribute);
        if (!element.has(key.c_str())) continue;
        if (std::find(kind.amounts.begin(), kind.amounts.end(), attribute) == kind.amounts.end())
            element.refuse(key.c_str(), fmt::format("does not state the amount of {} (allowed: {})", what,
                                                    fmt::join(kind.amounts, ", ")));
        if (found) element.fail(fmt::format("has two amounts, '{}' and '{}' (one is allowed)", *found, key));
        found = key;
    }
    if (found) element.refuse("scale", fmt::format("cannot stand beside the amount '{}'", *found));
    return found;
}

/// Without an amount the spectrum's own numbers count: they must be of the source's quantity, or be claimed
/// by scale=.
void checkAbsolute(const Element& element, const Spectrum& spectrum, const KindOfSource& kind,
                   const std::string& what) {
    const bool otherQuantity = spectrum.quantity != Quantity::unknown && spectrum.quantity != kind.own;
    if (!spectrum.relative && otherQuantity)
        element.fail(
            "spectrum",
            fmt::format("without an amount the spectrum of {} must be of quantity {}, this one is of {} ({})",
                        what, name(kind.own), name(spectrum.quantity), waysToSayIt(kind)));
    if (element.has("scale")) return;
    if (spectrum.relative)
        element.fail("spectrum", fmt::format("the spectrum is relative, so {} needs an amount ({})", what,
                                             waysToSayIt(kind)));
    if (spectrum.quantity == Quantity::unknown)
        element.fail(
            "spectrum",
            fmt::format("the spectrum does not say of which quantity it is, so {} needs an amount ({})", what,
                        waysToSayIt(kind)));
}

}  // namespace

namespace {

/// Stands for the mean of a pass until that is rendered: absolute where a pass holds what the source sends.
Spectrum spectrumOfPass(const Element& element, const KindOfSource& rules) {
    Spectrum spectrum;
    spectrum.text = element.text("spectrum");
    spectrum.quantity = rules.own;
    spectrum.relative = rules.own == Quantity::intensity;
    // A shape until then; an amount may be asked of it.
    spectrum.curves = {Curve::table({380, 780}, {1, 1})};
    return spectrum;
}

}  // namespace

Emitter readEmitter(Reading& reading, const Element& element, SourceKind kind, const std::string& what) {
    const KindOfSource& rules = kindOfSource(kind);
    Emitter emitter;
    emitter.where = element.where();
    const bool ofPass = element.text("spectrum").starts_with("pass:");
    emitter.spectrum =
        ofPass ? spectrumOfPass(element, rules) : reading.spectrum(element, "spectrum", Role::light);
    if (ofPass) {
        emitter.texture = readTexture(
            reading, element,
            kind == SourceKind::irradiance ? TextureRole::irradiance : TextureRole::radiance, "spectrum");
    }
    const auto attribute = amountAttribute(element, rules, what);
    emitter.scale = element.number("scale", 1, notNegative);
    if (!attribute) {
        checkAbsolute(element, emitter.spectrum, rules, what);
        return emitter;
    }
    std::string complaint;
    emitter.amount = parseAmount(*attribute, element.text(attribute->c_str()), complaint);
    if (!emitter.amount) element.fail(attribute->c_str(), complaint);
    const Curve& curve = emitter.spectrum.curve();
    if (!isPhotometric(emitter.amount->unit) && !emitter.amount->over && curve.isConstant() && !curve.range())
        element.fail(attribute->c_str(),
                     fmt::format("a constant spectrum has no range of its own to integrate over; say one, "
                                 "as in '{} over 400:700'",
                                 element.text(attribute->c_str())));
    if (emitter.amount->value > 0 && curve.lines().empty() && curve.bounds().second <= 0)
        element.fail("spectrum",
                     fmt::format("the spectrum is zero everywhere, no factor gives it the amount of '{}'",
                                 *attribute));
    return emitter;
}

Emitter readGlow(Reading& reading, const Element& element, const std::string& what) {
    if (element.has("spectrum") == element.has("texture"))
        element.fail(element.has("texture") ? "has both 'spectrum' and 'texture' (one is allowed)"
                                            : "needs the attribute 'spectrum' or 'texture'");
    if (!element.has("texture")) {
        element.refuse("filter", "stands only beside 'texture'");
        return readEmitter(reading, element, SourceKind::radiance, what);
    }
    for (std::string_view amount : amountAttributes())
        element.refuse(
            std::string(amount).c_str(),
            "cannot stand beside 'texture', whose radiances are absolute (scale= multiplies them)");
    Emitter emitter;
    emitter.where = element.where();
    emitter.texture = readTexture(reading, element, TextureRole::radiance);
    emitter.scale = element.number("scale", 1, notNegative);
    return emitter;
}

}  // namespace spectrad
