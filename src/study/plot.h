// Plots as SVG for the study's page: no script, no request to anywhere.
#pragma once

#include <string>
#include <vector>

namespace spectrad {

struct PlotPoint {
    double x, y;
    std::string label;      ///< shown when the pointer rests on it
    std::string name = {};  ///< written beside it
};
struct PlotSeries {
    std::string name;
    std::vector<PlotPoint> points;
    bool joined = false;
};
struct Plot {
    std::string title, xLabel, yLabel;
    bool logX = false, logY = false;  ///< values that are not positive are drawn at the lower edge
    std::vector<PlotSeries> series;
};
/// An <svg> element; nothing drawn where no series has a point.
[[nodiscard]] std::string svgOf(const Plot& plot);
/// Text for HTML and SVG.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace spectrad
