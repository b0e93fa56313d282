#include "cli/study_files.h"

#include "base/files.h"
#include "base/text.h"
#include "study/page.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace spectrad {

namespace fs = std::filesystem;

namespace {

Json rowJson(const StudyRow& row) {
    Json out{
        {"light", row.light},
        {"observer", row.observer},
        {"setting", row.key},
        {"knob", row.knob},
        {"what", row.what},
        {"bands", row.bands},
        {"samples", row.samples},
        {"seconds", {{"plan", row.planSeconds}, {"render", row.renderSeconds}, {"write", row.writeSeconds}}},
        {"strip_bytes", row.stripBytes},
        {"file_bytes", row.fileBytes},
        {"deltae00",
         {{"mean", row.deltaMean},
          {"p95", row.deltaP95},
          {"p99", row.deltaP99},
          {"max", row.deltaMax},
          {"max_at", {row.worstX, row.worstY}}}},
        {"width", row.width},
        {"height", row.height}};
    out["band_relative_max"] = row.hasBands ? Json(row.bandRelativeMax) : Json();
    out["spectral_angle_max_rad"] = row.hasBands ? Json(row.spectralAngleMax) : Json();
    return out;
}

StudyRow rowFrom(const Json& json) {
    StudyRow row;
    row.light = json.at("light");
    row.observer = json.at("observer");
    row.key = json.at("setting");
    row.knob = json.at("knob");
    row.what = json.at("what");
    row.bands = json.at("bands");
    row.samples = json.at("samples");
    row.planSeconds = json.at("seconds").at("plan");
    row.renderSeconds = json.at("seconds").at("render");
    row.writeSeconds = json.at("seconds").at("write");
    row.stripBytes = json.at("strip_bytes");
    row.fileBytes = json.at("file_bytes");
    const Json& delta = json.at("deltae00");
    row.deltaMean = delta.at("mean");
    row.deltaP95 = delta.at("p95");
    row.deltaP99 = delta.at("p99");
    row.deltaMax = delta.at("max");
    row.worstX = delta.at("max_at").at(0);
    row.worstY = delta.at("max_at").at(1);
    row.width = json.at("width");
    row.height = json.at("height");
    row.hasBands = !json.at("band_relative_max").is_null();
    if (row.hasBands) {
        row.bandRelativeMax = json.at("band_relative_max");
        row.spectralAngleMax = json.at("spectral_angle_max_rad");
    }
    return row;
}

StudySpectrum spectrumFrom(const Json& json) {
    return {json.at("light"), json.at("observer"),       json.at("setting"), json.at("x"),
            json.at("y"),     json.at("wavelengths_nm"), json.at("radiance")};
}

std::string csvOf(const StudyReport& report) {
    std::string out =
        "light,observer,setting,knob,bands,samples,deltae00_mean,deltae00_p95,deltae00_p99,deltae00_max,max_"
        "x,max_y,"
        "band_relative_max,spectral_angle_max_rad,plan_s,render_s,write_s,strip_bytes,file_bytes\n";
    for (const StudyRow& row : report.rows) {
        const auto bands = [&](double value) { return row.hasBands ? shortest(value) : std::string(); };
        out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", row.light,
                           row.observer, row.key, row.knob, row.bands, row.samples, shortest(row.deltaMean),
                           shortest(row.deltaP95), shortest(row.deltaP99), shortest(row.deltaMax), row.worstX,
                           row.worstY, bands(row.bandRelativeMax), bands(row.spectralAngleMax),
                           shortest(row.planSeconds), shortest(row.renderSeconds), shortest(row.writeSeconds),
                           row.stripBytes, row.fileBytes);
    }
    return out;
}

/// Maps that say something at a glance; the rest lie beside the page.
bool shown(const StudyRow& row) {
    return row.key == "slit-10nm" || row.key == "point-10nm" || row.key == "rgb";
}

}  // namespace

std::string mapName(const StudyRow& row) {
    std::string name = "map-" + row.light + "-" + row.observer + "-" + row.key + ".png";
    for (char& c : name)
        if (std::string_view("/\\:*?\"<>| ").find(c) != std::string_view::npos) c = '_';
    return name;
}

Json described(const StudyReport& report) {
    Json out;
    out["rows"] = Json::array();
    for (const StudyRow& row : report.rows)
        out["rows"].push_back(rowJson(row));
    out["spectra"] = Json::array();
    for (const StudySpectrum& spectrum : report.spectra)
        out["spectra"].push_back({{"light", spectrum.light},
                                  {"observer", spectrum.observer},
                                  {"setting", spectrum.key},
                                  {"x", spectrum.x},
                                  {"y", spectrum.y},
                                  {"wavelengths_nm", spectrum.nm},
                                  {"radiance", spectrum.radiance}});
    out["left_out"] = report.leftOut;
    return out;
}

StudyFiles::StudyFiles(fs::path folder, StudyIdentity identity)
    : folder_(std::move(folder)), identity_(std::move(identity)) {
    std::error_code failed;
    fs::create_directories(folder_, failed);
    if (failed || !fs::is_directory(folder_))
        throw MachineError("cannot make the folder '" + folder_.string() +
                           "': " + (failed ? failed.message() : "something else is there"));
    const fs::path file = folder_ / "results.json";
    if (!fs::exists(file)) return;
    // What is no study of ours, or of something else, is begun anew.
    const Json json = Json::parse(readFile(file), nullptr, false);
    if (json.is_discarded() || !json.is_object() || json.value("scene_sha256", "") != identity_.sceneSha256 ||
        json.value("command", "") != identity_.command || json.value("device", "") != identity_.device)
        return;
    try {
        for (const Json& row : json.at("rows"))
            whole_.rows.push_back(rowFrom(row));
        for (const Json& spectrum : json.at("spectra"))
            whole_.spectra.push_back(spectrumFrom(spectrum));
    } catch (const Json::exception&) {
        whole_ = {};
    }
}

std::set<std::string> StudyFiles::done() const {
    std::set<std::string> names;
    for (const StudyRow& row : whole_.rows)
        names.insert(doneName(row.light, row.observer, row.key));
    return names;
}

void StudyFiles::save() const {
    Json json{{"scene_sha256", identity_.sceneSha256},
              {"command", identity_.command},
              {"device", identity_.device}};
    json.update(described(whole_));
    writeFile(folder_ / "results.json", json.dump(1) + "\n");
}

void StudyFiles::add(const StudyRow& row) {
    whole_.rows.push_back(row);
    save();
}

const StudyReport& StudyFiles::finish(StudyReport report, const std::string& sceneFile) {
    for (StudySpectrum& spectrum : report.spectra)
        whole_.spectra.push_back(std::move(spectrum));
    whole_.leftOut = std::move(report.leftOut);
    save();
    writeFile(folder_ / "results.csv", csvOf(whole_));
    std::map<std::string, std::string> maps;
    PageHead head{sceneFile, identity_.device, "", identity_.command};
    for (const StudyRow& row : whole_.rows) {
        head.size = fmt::format("{} × {} pixels", row.width, row.height);
        const fs::path map = folder_ / mapName(row);
        if (shown(row) && fs::exists(map)) maps[doneName(row.light, row.observer, row.key)] = readFile(map);
    }
    writeFile(folder_ / "index.html", pageOf(head, whole_, maps));
    return whole_;
}

}  // namespace spectrad
