#include "study/page.h"

#include "base/text.h"
#include "study/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace spectrad {

namespace {

constexpr const char* style = R"(<style>
body { font: 15px/1.45 system-ui, sans-serif; max-width: 1340px; margin: 2em auto; padding: 0 1em; color: #222; }
svg text { font: 11px system-ui, sans-serif; fill: #333; } svg .title text { font-size: 13px; font-weight: 600; }
.grid { stroke: #ddd; } .plots { display: flex; flex-wrap: wrap; gap: 1em; } .plots svg { flex: 1 1 480px; max-width: 660px; height: auto; }
table { border-collapse: collapse; font-size: 13px; } td, th { padding: .2em .6em; border-bottom: 1px solid #ddd; text-align: right; }
td.word, th.word { text-align: left; } figure { display: inline-block; width: 340px; vertical-align: top; margin: 0 1em 1em 0; } figcaption { font-size: 13px; }
img { image-rendering: pixelated; width: 340px; }
</style>)";

using Rows = std::vector<const StudyRow*>;

/// The rows of one light and observer.
Rows under(const StudyReport& report, const std::string& light, const std::string& observer) {
    Rows rows;
    for (const StudyRow& row : report.rows)
        if (row.light == light && row.observer == observer) rows.push_back(&row);
    return rows;
}

std::string labelOf(const StudyRow& row) {
    return fmt::format("{}: 99 % within {}, {} ms", row.what, rounded(row.deltaP99, 3),
                       rounded(1e3 * row.renderSeconds, 3));
}

/// Those that no other beats: as fast, and with an error that is smaller or within 2 % of theirs.
PlotSeries front(const Rows& rows) {
    constexpr double asGood = 1.02;
    PlotSeries series{"nothing better", {}, true};
    for (const StudyRow* row : rows) {
        const bool beaten = std::any_of(rows.begin(), rows.end(), [&](const StudyRow* other) {
            return other != row && other->renderSeconds < row->renderSeconds &&
                   other->deltaP99 <= asGood * row->deltaP99;
        });
        if (!beaten && row->knob != "samples" && row->knob != "texture")
            series.points.push_back({row->renderSeconds, row->deltaP99, labelOf(*row), row->key});
    }
    std::sort(series.points.begin(), series.points.end(),
              [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
    return series;
}

std::string pareto(const Rows& rows) {
    Plot plot{"Time against error", "seconds to render", "ΔE00, 99 % of the pixels within", true, true, {}};
    const char* knobs[] = {"bands", "baseline", "output", "fresnel", "texture", "arithmetic"};
    for (const char* knob : knobs) {
        PlotSeries series{knob, {}, false};
        for (const StudyRow* row : rows)
            if (row->knob == knob)
                series.points.push_back({row->renderSeconds, row->deltaP99, labelOf(*row)});
        if (!series.points.empty()) plot.series.push_back(series);
    }
    plot.series.push_back(front(rows));
    return svgOf(plot);
}

std::string bandPlot(const Rows& rows) {
    Plot plot{"How many bands", "bands", "ΔE00, 99 % of the pixels within", true, true, {}};
    for (const char* projection : {"slit", "box", "point"}) {
        PlotSeries series{projection, {}, true};
        for (const StudyRow* row : rows)
            if (row->knob == "bands" && row->key.starts_with(projection))
                series.points.push_back({static_cast<double>(row->bands), row->deltaP99, labelOf(*row)});
        std::sort(series.points.begin(), series.points.end(),
                  [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
        if (!series.points.empty()) plot.series.push_back(series);
    }
    for (const auto& [prefix, label] : {std::pair{"gauss-", "Gauss"}, {"linear-", "linear model"}}) {
        PlotSeries series{label, {}, true};
        for (const StudyRow* row : rows)
            if (row->key.starts_with(prefix))
                series.points.push_back({static_cast<double>(row->bands), row->deltaP99, labelOf(*row)});
        if (!series.points.empty()) plot.series.push_back(series);
    }
    return svgOf(plot);
}

std::string samplePlot(const Rows& rows) {
    Plot plot{"How many samples", "samples a pixel", "ΔE00 against 64 samples", true, true, {}};
    PlotSeries mean{"mean", {}, true}, p99{"99 % within", {}, true};
    for (const StudyRow* row : rows) {
        if (row->knob != "samples") continue;
        mean.points.push_back({static_cast<double>(row->samples), row->deltaMean, row->what});
        p99.points.push_back({static_cast<double>(row->samples), row->deltaP99, row->what});
    }
    for (PlotSeries* series : {&mean, &p99})
        std::sort(series->points.begin(), series->points.end(),
                  [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
    plot.series = {mean, p99};
    return svgOf(plot);
}

std::string spectraPlot(const StudyReport& report, const std::string& light, const std::string& observer) {
    Plot plot;
    for (const StudySpectrum& spectrum : report.spectra) {
        if (spectrum.light != light || spectrum.observer != observer) continue;
        plot.title = fmt::format("Where points are worst: pixel {}, {}", spectrum.x, spectrum.y);
        plot.xLabel = "wavelength, nm";
        plot.yLabel = "radiance, W m⁻² sr⁻¹ nm⁻¹";
        PlotSeries series{spectrum.key, {}, true};
        for (size_t i = 0; i < spectrum.nm.size(); ++i)
            series.points.push_back(
                {spectrum.nm[i], spectrum.radiance[i],
                 fmt::format("{} nm: {}", rounded(spectrum.nm[i], 6), rounded(spectrum.radiance[i], 6))});
        plot.series.push_back(std::move(series));
    }
    return svgOf(plot);
}

std::string tableOf(const Rows& rows) {
    std::string out = "<table><tr><th class=word>setting<th class=word>what";
    for (const char* head : {"bands", "samples", "ΔE00 mean", "95 %", "99 %", "max", "band error",
                             "angle, rad", "render, ms", "memory, MB", "write, ms", "file, MB"})
        out += std::string("<th>") + head;
    out += "</tr>\n";
    const auto given = [](bool there, double value) { return there ? rounded(value, 3) : std::string("–"); };
    for (const StudyRow* row : rows) {
        out += fmt::format("<tr><td class=word>{}<td class=word>{}<td>{}<td>{}", escaped(row->key),
                           escaped(row->what), row->bands, row->samples);
        const bool written = row->fileBytes > 0;
        for (const std::string& cell :
             {rounded(row->deltaMean, 3), rounded(row->deltaP95, 3), rounded(row->deltaP99, 3),
              rounded(row->deltaMax, 3), given(row->hasBands, row->bandRelativeMax),
              given(row->hasBands, row->spectralAngleMax), rounded(1e3 * row->renderSeconds, 3),
              given(row->stripBytes > 0, 1e-6 * static_cast<double>(row->stripBytes)),
              given(written, 1e3 * row->writeSeconds),
              given(written, 1e-6 * static_cast<double>(row->fileBytes))})
            out += "<td>" + cell;
        out += "</tr>\n";
    }
    return out + "</table>\n";
}

}  // namespace

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        const size_t count = std::min<size_t>(3, bytes.size() - i);
        for (size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k)
            out += k <= count ? digits[group >> (18 - 6 * k) & 63u] : '=';
    }
    return out;
}

std::string pageOf(const PageHead& head, const StudyReport& report,
                   const std::map<std::string, std::string>& maps) {
    std::string out =
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
        "img-src data:; style-src 'unsafe-inline'\"><title>" +
        escaped(head.scene) + ": speed against accuracy</title>\n" + style + "</head><body>\n";
    out += fmt::format("<h1>{}: speed against accuracy</h1>\n<p>{}, {}; <code>{}</code></p>\n",
                       escaped(head.scene), escaped(head.size), escaped(head.device), escaped(head.command));
    out +=
        "<p>Each setting is held against the same scene at every nanometre from 360 to 830 nm (slit bands, "
        "the same "
        "samples; numbers of samples and filters of textures against 64). ΔE00 is CIEDE2000 against the "
        "scene's first light at the "
        "reference's brightest luminance. Band error and spectral angle are of the bands themselves, against "
        "the "
        "averages that a slit records at those wavelengths. Times are the better of two on this machine, "
        "kernels "
        "compiled before.</p>\n";
    std::set<std::pair<std::string, std::string>> seen;
    for (const StudyRow& first : report.rows) {
        if (!seen.insert({first.light, first.observer}).second) continue;
        const Rows rows = under(report, first.light, first.observer);
        out += fmt::format("<h2>{}, seen by {}</h2>\n<div class=plots>\n",
                           first.light == "scene" ? "the scene's own light" : escaped(first.light),
                           escaped(first.observer));
        out += pareto(rows) + bandPlot(rows) + samplePlot(rows) +
               spectraPlot(report, first.light, first.observer) + "</div>\n<div>";
        for (const StudyRow* row : rows) {
            const auto map = maps.find(doneName(row->light, row->observer, row->key));
            if (map == maps.end()) continue;
            out += fmt::format(
                "<figure><img alt=\"ΔE00 of each pixel\" src=\"data:image/png;base64,{}\"><figcaption>{}: "
                "ΔE00 from 0 "
                "(dark blue) to {} (yellow)</figcaption></figure>\n",
                base64(map->second), escaped(row->what), rounded(row->deltaMax, 3));
        }
        out += "</div>\n" + tableOf(rows);
    }
    if (!report.leftOut.empty()) {
        out += "<h2>Left out</h2><ul>\n";
        for (const std::string& line : report.leftOut)
            out += "<li>" + escaped(line) + "</li>\n";
        out += "</ul>\n";
    }
    return out + "</body></html>\n";
}

}  // namespace spectrad
