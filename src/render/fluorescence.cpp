#include "render/fluorescence.h"

#include "base/files.h"
#include "base/text.h"
#include "render/cumulative.h"
#include "spectrum/projection.h"
#include "spectrum/readers/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace spectrad {

DonaldsonMatrix readDonaldson(const std::string& file) {
    const SpectrumTable table = readTable(file);
    DonaldsonMatrix matrix;
    matrix.emission = table.nm;
    std::vector<std::pair<double, size_t>> order;
    for (size_t c = 0; c < table.header.size(); ++c) {
        const std::string& name = table.header[c];
        const std::optional<double> nm =
            startsWith(name, "ex") ? parseDouble(std::string_view(name).substr(2)) : std::nullopt;
        if (!nm || !(*nm > 0))
            throw InputError(
                file + ": column '" + name +
                "' of a bispectral matrix is not called exNNN (NNN: excitation wavelength in nm)");
        order.emplace_back(*nm, c);
    }
    std::sort(order.begin(), order.end());
    for (size_t i = 0; i + 1 < order.size(); ++i)
        if (order[i].first == order[i + 1].first)
            throw InputError(file + ": two columns for the excitation wavelength " +
                             shortest(order[i].first) + " nm");
    if (order.size() < 2)
        throw InputError(file + ": a bispectral matrix needs at least two excitation columns");
    if (matrix.emission.size() < 2)
        throw InputError(file + ": a bispectral matrix needs at least two emission rows");
    matrix.value.assign(matrix.emission.size(), {});
    for (const auto& [nm, column] : order) {
        matrix.excitation.push_back(nm);
        for (size_t row = 0; row < matrix.emission.size(); ++row)
            matrix.value[row].push_back(table.columns[column][row]);
    }
    return matrix;
}

FluorescentBase::FluorescentBase(const Material& material, double inside, Notes& notes)
    : base_(Curve::constant(0)), inside_(inside) {
    if (material.diffuse && material.diffuse->reflectance) {
        base_ = material.diffuse->reflectance->curve();
        black_ = base_.isConstant() && base_.at(550) == 0;
    }
    for (const Fluorescence& part : material.fluorescence)
        if (!part.matrixFile.empty()) addMatrix(part, material, notes);
    for (const Fluorescence& part : material.fluorescence)
        if (part.matrixFile.empty()) addSeparable(part);
    checkAbsorption(material, notes);
    if (!separable_.empty() || !bispectral_.empty()) black_ = false;
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
    DonaldsonMatrix m = readDonaldson(part.matrixFile);
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
    std::vector<double> diagonalNm, diagonal;
    size_t zeroed = 0;
    double zeroedMost = 0;
    for (size_t row = 0; row < m.emission.size(); ++row) {
        for (size_t i = 0; i < columns; ++i) {
            double& value = m.value[row][i];
            if (m.emission[row] == ex[i] && !part.diagonalNone) {
                diagonalNm.push_back(ex[i]);
                diagonal.push_back(value);
                value = 0;
            } else if (m.emission[row] < ex[i] && !part.antiStokes) {
                if (value != 0) ++zeroed, zeroedMost = std::max(zeroedMost, std::abs(value));
                value = 0;
            }
        }
    }
    if (zeroed > 0)
        notes.say(
            fmt::format("{}: {} cells whose emission lies below the excitation set to zero (largest {})",
                        part.matrixFile, zeroed, rounded(zeroedMost, 3)));
    if (!part.diagonalNone) {
        if (material.diffuse)
            throw InputError(
                part.where,
                "the matrix's diagonal is the reflectance: leave out <diffuse>, or say diagonal=\"none\"");
        if (diagonal.empty())
            throw InputError(
                part.where,
                "the matrix has no diagonal (no row at an excitation wavelength): say diagonal=\"none\"");
        if (!black_)
            throw InputError(part.where,
                             "two matrices with a diagonal: one of them must say diagonal=\"none\"");
        size_t clipped = 0;
        for (double& value : diagonal) {
            if (value < 0) ++clipped;
            value = std::max(value, 0.0);
        }
        if (clipped > 0)
            notes.say(fmt::format("{}: {} negative reflectances on the diagonal set to zero", part.matrixFile,
                                  clipped));
        base_ = Curve::table(diagonalNm, diagonal, Outside::hold);
        black_ = false;
    }
    // Energy out per energy in: what column i sends out over all wavelengths, per nm of its band, and what it
    // reflects.
    size_t tooMuch = 0;
    double most = 0;
    for (size_t i = 0; i < columns; ++i) {
        double out = 0;
        for (size_t row = 0; row + 1 < m.emission.size(); ++row)
            out += 0.5 * (m.value[row][i] + m.value[row + 1][i]) * (m.emission[row + 1] - m.emission[row]);
        const double ratio = out / (b.bandTo[i] - b.bandFrom[i]) + (part.diagonalNone ? 0 : base_.at(ex[i]));
        if (ratio > 1) ++tooMuch;
        most = std::max(most, ratio);
    }
    if (tooMuch > 0)
        notes.warn(
            part.where,
            fmt::format("{}: {} excitation bands send out more energy than they take in (up to {} of it)",
                        part.matrixFile, tooMuch, rounded(most, 4)));
    b.value = std::move(m.value);
    bispectral_.push_back(std::move(b));
}

double FluorescentBase::amplified(double nm) const {
    return inside_ == 0 ? 1 : 1 / (1 - base_.at(nm) * inside_);
}

Curve FluorescentBase::reflectance() const {
    if (inside_ == 0) return base_;
    const double r = inside_;
    return Curve::combined({base_},
                           [r](std::span<const double> v) { return v[0] * (1 - r) / (1 - v[0] * r); });
}

std::vector<Curve> FluorescentBase::reradiation(const Curve& light) const {
    std::vector<Curve> curves;
    for (const Separable& part : separable_)
        curves.push_back(glow(part, light));
    for (const Bispectral& part : bispectral_)
        curves.push_back(glow(part, light));
    return curves;
}

// M(λo, λi) = Q · a(λi) · λi · e(λo) / ∫ e λ dλ for λi ≤ λo: the emission's curve times the photons absorbed
// so far. Under a coat light of λi comes back to the base, and so does what it sends out.
Curve FluorescentBase::glow(const Separable& part, const Curve& light) const {
    const double r = inside_;
    const Curve absorbed = Curve::combined({part.excitation, base_}, [r](std::span<const double> v) {
        return v[0] * std::max(0.0, 1 - v[1]) / (1 - v[1] * r);
    });
    const Curve photons =
        Curve::formula([](double nm) { return nm; }, [](double, double, std::vector<double>&) {});
    const auto range = part.emission.range();
    const Cumulative taken({absorbed, photons}, light, part.excitation.range());
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
    const Curve gain =
        Curve::combined({base_}, [r = inside_](std::span<const double> v) { return 1 / (1 - v[0] * r); });
    for (size_t i = 0; i < part.bandCentre.size(); ++i) {
        const std::array<const Curve*, 2> product{&light, &gain};
        irradiance.push_back(integrate(product, part.bandFrom[i], part.bandTo[i]) /
                             (part.bandTo[i] - part.bandFrom[i]));
    }
    std::vector<double> sum;
    for (size_t row = 0; row < part.emission.size(); ++row) {
        double value = 0;
        for (size_t i = 0; i < irradiance.size(); ++i)
            value += part.value[row][i] * irradiance[i];
        sum.push_back(value * (1 - inside_) * amplified(part.emission[row]));
    }
    return Curve::table(part.emission, sum, Outside::zero);
}

}  // namespace spectrad
