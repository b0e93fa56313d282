#include "render/fluorescence.h"

#include "base/text.h"
#include "render/cumulative.h"
#include "render/donaldson.h"
#include "spectrum/projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace spectrad {

FluorescentBase::FluorescentBase(const Material& material, double inside, Notes& notes,
                                 const std::optional<Entry>& entry)
    : base_(Curve::constant(0)), inside_(inside), insideIn_(entry ? entry->inside : inside) {
    if (entry && entry->weight) weightIn_ = *entry->weight;
    if (material.diffuse && material.diffuse->reflectance) {
        base_ = material.diffuse->reflectance->curve();
        black_ = base_.isConstant() && base_.at(550) == 0;
    }
    const auto& parts = material.fluorescence;
    for (size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].matrixFile.empty()) continue;
        addMatrix(parts[i], material, notes);
        bispectral_.back().number = i;
    }
    for (size_t i = 0; i < parts.size(); ++i) {
        if (!parts[i].matrixFile.empty()) continue;
        addSeparable(parts[i]);
        separable_.back().number = i;
    }
    checkAbsorption(material, notes);
}

void FluorescentBase::addSeparable(const Fluorescence& part) {
    Separable s;
    const Curve& x = part.excitation->curve();
    const double peak = x.bounds().second;
    if (!(peak > 0))
        throw InputError(part.where, "excitation '" + part.excitation->text + "' is zero everywhere");
    s.excitation = x.scaled(1 / peak);
    const Curve wavelength =
        Curve::formula([](double nm) { return nm; }, [](double, double, std::vector<double>&) {});
    const Curve& e = part.emission->curve();
    if (!e.range())
        throw InputError(part.where, "emission '" + part.emission->text + "' goes on at all wavelengths");
    // Photons per nm over λ are energy per nm: e λ is then the counted shape itself.
    const std::array<const Curve*, 2> photons{&e, &wavelength};
    const std::array<const Curve*, 1> counted{&e};
    const double total = part.emissionInPhotons ? integrate(counted) : integrate(photons);
    if (!(total > 0)) throw InputError(part.where, "emission '" + part.emission->text + "' has no energy");
    s.emission = part.emissionInPhotons
                     ? Curve::combined({e, wavelength}, [](std::span<const double> v) { return v[0] / v[1]; })
                     : e;
    s.factor = part.yield * part.strength / total;
    s.strength = part.strength;
    s.yield = part.yield;
    s.antiStokes = part.antiStokes;
    separable_.push_back(std::move(s));
}

void FluorescentBase::checkAbsorption(const Material& material, Notes& notes) const {
    if (separable_.size() < 2) return;
    std::vector<Curve> excitations;
    for (const Separable& part : separable_)
        excitations.push_back(part.excitation.scaled(part.strength));
    const Curve together = Curve::combined(
        excitations, [](std::span<const double> v) { return std::accumulate(v.begin(), v.end(), 0.0); });
    const double most = together.bounds().second;
    if (most > 1 + 1e-9)
        notes.warn(material.where, fmt::format("the fluorophores of material '{}' together absorb up to {} "
                                               "times what the base does not reflect: "
                                               "energy is gained unless their strengths are lowered",
                                               material.name, rounded(most, 4)));
}

void FluorescentBase::addMatrix(const Fluorescence& part, const Material& material, Notes& notes) {
    DonaldsonMatrix m = readDonaldson(part.matrixFile, notes);
    const auto& ex = m.excitation;
    const size_t columns = ex.size();
    Bispectral b;
    b.emission = m.emission;
    b.bandCentre = ex;
    for (size_t i = 0; i < columns; ++i) {
        const double below = i > 0 ? ex[i] - ex[i - 1] : ex[1] - ex[0],
                     above = i + 1 < columns ? ex[i + 1] - ex[i] : ex[i] - ex[i - 1];
        b.bandFrom.push_back(ex[i] - below / 2);
        b.bandTo.push_back(ex[i] + above / 2);
    }
    b.changes.file = part.matrixFile;
    b.changes.columns = columns;
    std::vector<double> diagonalNm, diagonal;
    for (size_t row = 0; row < m.emission.size(); ++row) {
        for (size_t i = 0; i < columns; ++i) {
            double& value = m.value[row][i];
            if (m.emission[row] == ex[i] && !part.diagonalNone) {
                diagonalNm.push_back(ex[i]);
                diagonal.push_back(value);
                value = 0;
            } else if (m.emission[row] < ex[i] && !part.antiStokes) {
                if (value != 0) ++b.changes.zeroed;
                b.changes.zeroedMost = std::max(b.changes.zeroedMost, std::abs(value));
                value = 0;
            }
        }
    }
    if (b.changes.zeroed > 0)
        notes.say(
            fmt::format("{}: {} cells whose emission lies below the excitation set to zero (largest {})",
                        part.matrixFile, b.changes.zeroed, rounded(b.changes.zeroedMost, 3)));
    if (!part.diagonalNone) takeDiagonal(part, material, diagonalNm, std::move(diagonal), b.changes, notes);
    b.value = std::move(m.value);
    for (size_t i = 0; i < columns; ++i) {
        const double reflected = part.diagonalNone ? 0 : base_.at(ex[i]);
        const double energy = b.energyOut(i) + reflected;
        if (energy > 1) ++b.changes.tooMuch;
        b.changes.mostEnergy = std::max(b.changes.mostEnergy, energy);
        b.changes.mostPhotons = std::max(b.changes.mostPhotons, b.photonsOut(i) + reflected);
    }
    if (b.changes.tooMuch > 0)
        notes.warn(
            part.where,
            fmt::format("{}: {} excitation bands send out more energy than they take in (up to {} of it)",
                        part.matrixFile, b.changes.tooMuch, rounded(b.changes.mostEnergy, 4)));
    bispectral_.push_back(std::move(b));
}

void FluorescentBase::takeDiagonal(const Fluorescence& part, const Material& material,
                                   const std::vector<double>& nm, std::vector<double> value,
                                   MatrixChanges& changes, Notes& notes) {
    if (material.diffuse)
        throw InputError(
            part.where,
            "the matrix's diagonal is the reflectance: leave out <diffuse>, or say diagonal=\"none\"");
    if (value.empty())
        throw InputError(
            part.where,
            "the matrix has no diagonal (no row at an excitation wavelength): say diagonal=\"none\"");
    if (!black_)
        throw InputError(part.where, "two matrices with a diagonal: one of them must say diagonal=\"none\"");
    for (double& v : value) {
        if (v < 0) ++changes.clipped;
        v = std::max(v, 0.0);
    }
    if (changes.clipped > 0)
        notes.say(fmt::format("{}: {} negative reflectances on the diagonal set to zero", part.matrixFile,
                              changes.clipped));
    base_ = Curve::table(nm, std::move(value), Outside::hold);
    black_ = false;
}

Curve FluorescentBase::reflectance() const {
    if (inside_ == 0) return base_;
    const double r = inside_;
    return Curve::combined({base_},
                           [r](std::span<const double> v) { return v[0] * (1 - r) / (1 - v[0] * r); });
}

std::vector<Curve> FluorescentBase::reradiation(const Curve& light) const {
    std::vector<size_t> all(separable_.size() + bispectral_.size());
    std::iota(all.begin(), all.end(), size_t{0});
    return reradiation(light, all);
}

std::vector<Curve> FluorescentBase::reradiation(const Curve& light, std::span<const size_t> parts) const {
    const auto wanted = [&](const auto& part) {
        return std::find(parts.begin(), parts.end(), part.number) != parts.end();
    };
    std::vector<Curve> curves;
    for (const Separable& part : separable_)
        if (wanted(part)) curves.push_back(glow(part, light));
    for (const Bispectral& part : bispectral_)
        if (wanted(part)) curves.push_back(glow(part, light));
    return curves;
}

// M(λo, λi) = Q · a(λi) · λi · e(λo) / ∫ e λ dλ for λi ≤ λo: the emission's curve times the photons absorbed
// so far. Under a coat light of λi comes back to the base, and so does what it sends out.
Curve FluorescentBase::glow(const Separable& part, const Curve& light) const {
    const double r = inside_;
    const Curve absorbed =
        Curve::combined({part.excitation, base_}, [in = insideIn_](std::span<const double> v) {
            return v[0] * std::max(0.0, 1 - v[1]) / (1 - v[1] * in);
        });
    const Curve photons =
        Curve::formula([](double nm) { return nm; }, [](double, double, std::vector<double>&) {});
    const auto range = part.emission.range();
    std::vector<Curve> weights{absorbed, photons};
    if (weightIn_) weights.push_back(*weightIn_);
    const Cumulative taken(std::move(weights), light, part.excitation.range());
    const Curve& e = part.emission;
    const double factor = part.factor * (1 - r);
    const bool antiStokes = part.antiStokes;
    const Curve base = base_;
    return Curve::formula(
        [=](double nm) {
            return factor * e.at(nm) * (antiStokes ? taken.total() : taken.upTo(nm)) / (1 - base.at(nm) * r);
        },
        [=](double from, double to, std::vector<double>& out) {
            std::vector<double> all;
            e.appendBreaks(from, to, all);
            base.appendBreaks(from, to, all);
            taken.appendBreaks(from, to, all);
            std::sort(all.begin(), all.end());
            out.insert(out.end(), all.begin(), all.end());
        },
        range);
}

Curve FluorescentBase::glow(const Bispectral& part, const Curve& light) const {
    std::vector<double> irradiance;
    const auto gainOf = [&](double inside) {
        return Curve::combined({base_},
                               [inside](std::span<const double> v) { return 1 / (1 - v[0] * inside); });
    };
    const Curve gain = gainOf(inside_), gainIn = gainOf(insideIn_);
    std::vector<const Curve*> product{&light, &gainIn};
    if (weightIn_) product.push_back(&*weightIn_);
    for (size_t i = 0; i < part.bandCentre.size(); ++i) {
        irradiance.push_back(integrate(product, part.bandFrom[i], part.bandTo[i]) /
                             (part.bandTo[i] - part.bandFrom[i]));
    }
    std::vector<double> sum;
    for (size_t row = 0; row < part.emission.size(); ++row) {
        double value = 0;
        for (size_t i = 0; i < irradiance.size(); ++i)
            value += part.value[row][i] * irradiance[i];
        sum.push_back(value * (1 - inside_));
    }
    // D is linear between its rows; what the coat makes of it has the base's own shape in between.
    Curve sent = Curve::table(part.emission, std::move(sum), Outside::zero);
    if (inside_ == 0) return sent;
    return Curve::combined({std::move(sent), gain}, [](std::span<const double> v) { return v[0] * v[1]; });
}

}  // namespace spectrad
