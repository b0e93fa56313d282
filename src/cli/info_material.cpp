#include "cli/info_material.h"

#include "base/text.h"
#include "cli/json.h"

#include <fmt/format.h>

namespace spectrad {

namespace {

Json described(const FluorophoreFigures& f) {
    Json json{{"excitation_peak_nm", orNull(f.excitationPeak)},
              {"emission_peak_nm", orNull(f.emissionPeak)},
              {"stokes_shift_nm", orNull(f.stokesShift())},
              {"quantum_yield", f.yield}};
    if (f.matrix)
        json["matrix"] = {{"file", f.matrix->file},
                          {"cells_zeroed", f.matrix->zeroed},
                          {"largest_zeroed", f.matrix->zeroedMost},
                          {"diagonal_clipped", f.matrix->clipped},
                          {"columns", f.matrix->columns},
                          {"columns_above_energy", f.matrix->tooMuch},
                          {"largest_energy_out", f.matrix->mostEnergy},
                          {"largest_photons_out", f.matrix->mostPhotons}};
    return json;
}

Json described(const MaterialReport& m) {
    Json json{{"name", m.name}, {"lobes", m.lobes}, {"terms", m.terms}};
    if (!m.fluorescence.empty()) {
        json["fluorescence"] = Json::array();
        for (const FluorophoreFigures& f : m.fluorescence)
            json["fluorescence"].push_back(described(f));
        json["peak_total_radiance_factor"] = Json::array();
        for (const PeakRadianceFactor& peak : m.peaks)
            json["peak_total_radiance_factor"].push_back(
                {{"light", peak.light}, {"wavelength_nm", peak.nm}, {"value", peak.value}});
    }
    if (m.fresnel) {
        const bool schlick = m.fresnel->model == FresnelFigures::Model::schlick;
        json["fresnel"] = {{"model", schlick ? "schlick" : "exact"},
                           {"terms", m.fresnel->terms},
                           {schlick ? "largest_error" : "largest_relative_error", m.fresnel->error}};
    }
    if (m.furnace)
        json["furnace"] = {
            {"least", m.furnace->least}, {"most", m.furnace->most}, {"bouncing", m.furnace->bouncing}};
    return json;
}

std::string peakText(const std::optional<double>& nm) {
    return nm ? rounded(*nm, 5) + " nm" : "at no wavelength";
}

void printFluorescence(const MaterialReport& m) {
    for (const FluorophoreFigures& f : m.fluorescence) {
        const auto shift = f.stokesShift();
        printText(fmt::format(
            "  fluorescence  excited at {}, emits at {} (Stokes shift {}); quantum yield {} there\n",
            peakText(f.excitationPeak), peakText(f.emissionPeak), shift ? rounded(*shift, 4) + " nm" : "none",
            rounded(f.yield, 4)));
        if (!f.matrix) continue;
        printText(fmt::format(
            "                {}: {} cells below the excitation set to zero (largest {}), {} negative "
            "reflectances set to zero; {} of {} columns send out more energy than they take in (largest {} "
            "of the energy, {} of the photons)\n",
            f.matrix->file, f.matrix->zeroed, rounded(f.matrix->zeroedMost, 3), f.matrix->clipped,
            f.matrix->tooMuch, f.matrix->columns, rounded(f.matrix->mostEnergy, 4),
            rounded(f.matrix->mostPhotons, 4)));
    }
    for (const PeakRadianceFactor& peak : m.peaks)
        printText(fmt::format("                total radiance factor up to {} at {} nm under {}\n",
                              rounded(peak.value, 4), rounded(peak.nm, 5), peak.light));
}

}  // namespace

Json described(const std::vector<MaterialReport>& materials) {
    Json json = Json::array();
    for (const MaterialReport& m : materials)
        json.push_back(described(m));
    return json;
}

void printMaterials(const std::vector<MaterialReport>& materials) {
    for (const MaterialReport& m : materials) {
        if (m.fluorescence.empty() && !m.fresnel && !(m.furnace && m.furnace->bouncing > 0)) continue;
        printText(
            fmt::format("material   {} ({}): {} terms a light\n", m.name, fmt::join(m.lobes, ", "), m.terms));
        printFluorescence(m);
        if (m.fresnel) {
            const bool schlick = m.fresnel->model == FresnelFigures::Model::schlick;
            printText(fmt::format("  Fresnel       {}, {} terms, off by at most {}{}\n",
                                  schlick ? "Schlick's formula" : "exact", m.fresnel->terms,
                                  rounded(m.fresnel->error, 2), schlick ? "" : " of the reflectance"));
        }
        if (m.furnace)
            printText(fmt::format("  white light   {} to {} of it come back over bands and views{}\n",
                                  rounded(m.furnace->least, 4), rounded(m.furnace->most, 4),
                                  m.furnace->bouncing > 0
                                      ? fmt::format("; {} bounce on between facets and are kept",
                                                    rounded(m.furnace->bouncing, 3))
                                      : ""));
    }
}

}  // namespace spectrad
