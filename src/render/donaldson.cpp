#include "render/donaldson.h"

#include "base/text.h"
#include "image/bispectral.h"
#include "image/exr_read.h"
#include "spectrum/readers/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

namespace spectrad {

namespace {

DonaldsonMatrix fromText(const std::string& file) {
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
    matrix.value.assign(matrix.emission.size(), {});
    for (const auto& [nm, column] : order) {
        matrix.excitation.push_back(nm);
        for (size_t row = 0; row < matrix.emission.size(); ++row)
            matrix.value[row].push_back(table.columns[column][row]);
    }
    return matrix;
}

DonaldsonMatrix fromExr(const std::string& file, Notes& notes) {
    const std::vector<BispectralCell> cells = readBispectral(file);
    std::set<double> in, out;
    for (const BispectralCell& cell : cells)
        in.insert(cell.inNm), out.insert(cell.outNm);
    DonaldsonMatrix matrix;
    matrix.excitation.assign(in.begin(), in.end());
    matrix.emission.assign(out.begin(), out.end());
    std::vector<std::vector<bool>> known(out.size(), std::vector<bool>(in.size(), false));
    matrix.value.assign(out.size(), std::vector<double>(in.size(), 0.0));
    for (const BispectralCell& cell : cells) {
        const auto row = static_cast<size_t>(std::distance(out.begin(), out.find(cell.outNm)));
        const auto column = static_cast<size_t>(std::distance(in.begin(), in.find(cell.inNm)));
        matrix.value[row][column] = cell.value;
        known[row][column] = true;
    }
    size_t missing = 0;
    for (size_t row = 0; row < out.size(); ++row)
        for (size_t column = 0; column < in.size(); ++column)
            if (!known[row][column] && matrix.emission[row] >= matrix.excitation[column]) ++missing;
    if (missing > 0)
        notes.say(
            fmt::format("{}: {} of {} pairs of wavelengths with the emission not below the excitation "
                        "have no channel: taken as 0",
                        file, missing, out.size() * in.size()));
    return matrix;
}

}  // namespace

DonaldsonMatrix readDonaldson(const std::string& file, Notes& notes) {
    DonaldsonMatrix matrix = startsLikeExr(file) ? fromExr(file, notes) : fromText(file);
    if (matrix.excitation.size() < 2)
        throw InputError(file + ": a bispectral matrix needs at least two excitation columns");
    if (matrix.emission.size() < 2)
        throw InputError(file + ": a bispectral matrix needs at least two emission rows");
    return matrix;
}

}  // namespace spectrad
