#include "render/reradiation_matrix.h"

#include "base/text.h"
#include "render/fluorescence.h"

#include <fmt/format.h>

#include <map>
#include <set>

namespace spectrad {

std::vector<BispectralCell> reradiationMatrix(const Material& material, std::span<const double> nm,
                                              Notes& notes) {
    if (material.fluorescence.empty())
        throw InputError(material.where, "material '" + material.name + "' does not fluoresce");
    if (nm.size() < 2) throw InputError("a bispectral matrix needs at least two wavelengths");
    bool pictured = material.diffuse && !material.diffuse->reflectance;
    for (const Fluorescence& part : material.fluorescence)
        pictured = pictured || part.mask;
    if (pictured)
        throw InputError(material.where, "material '" + material.name +
                                             "' differs from place to place: it has no one matrix");
    const FluorescentBase base(material, 0, notes);
    const Curve reflectance = base.reflectance();
    std::vector<BispectralCell> cells;
    for (size_t i = 0; i < nm.size(); ++i) {
        cells.push_back({nm[i], nm[i], reflectance.at(nm[i])});
        const double before = i > 0 ? nm[i] - nm[i - 1] : nm[1] - nm[0],
                     after = i + 1 < nm.size() ? nm[i + 1] - nm[i] : before;
        const std::vector<Curve> glows =
            base.reradiation(Curve::table({nm[i] - before / 2, nm[i] + after / 2}, {1, 1}));
        for (size_t o = i + 1; o < nm.size(); ++o) {
            double sum = 0;
            for (const Curve& glow : glows)
                sum += glow.at(nm[o]);
            cells.push_back({nm[i], nm[o], sum});
        }
    }
    return cells;
}

std::string bispectralCsv(std::span<const BispectralCell> cells) {
    std::set<double> in;
    std::map<double, std::map<double, double>> rows;
    for (const BispectralCell& cell : cells) {
        in.insert(cell.inNm);
        rows[cell.outNm][cell.inNm] = cell.value;
    }
    std::string text = "emission_nm";
    for (const double nm : in)
        text += ",ex" + shortest(nm);
    text += '\n';
    for (const auto& [out, row] : rows) {
        text += shortest(out);
        for (const double nm : in) {
            const auto cell = row.find(nm);
            text += "," + (cell == row.end() ? std::string("0") : shortest(cell->second));
        }
        text += '\n';
    }
    return text;
}

}  // namespace spectrad
