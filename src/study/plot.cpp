#include "study/plot.h"

#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace spectrad {

namespace {

constexpr double width = 640, height = 360, left = 70, right = 150, top = 34, bottom = 48;  // px
/// Okabe & Ito's colours, which most eyes tell apart.
constexpr std::array<const char*, 8> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                             "#e69f00", "#56b4e9", "#000000", "#888888"};

/// One axis: from values to pixels.
class Axis {
  public:
    /// `origin`: a linear axis may begin at zero where that wastes little.
    Axis(std::vector<double> values, bool log, bool origin, double from, double to)
        : log_(log), from_(from), to_(to) {
        if (log)
            values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return !(v > 0); }),
                         values.end());
        if (values.empty()) values = {1};
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        low_ = of(*least), high_ = of(*most);
        if (log) {
            low_ = std::floor(low_), high_ = std::ceil(high_);
        } else if (origin && low_ > 0 && low_ < 0.5 * high_) {
            low_ = 0;
        }
        if (!(high_ > low_)) high_ = low_ + 1;
    }
    [[nodiscard]] double at(double value) const {
        const double place = log_ && !(value > 0) ? low_ : std::clamp(of(value), low_, high_);
        return from_ + (place - low_) / (high_ - low_) * (to_ - from_);
    }
    [[nodiscard]] std::vector<double> ticks() const {
        std::vector<double> out;
        if (log_) {
            const double stride = std::max(1.0, std::ceil((high_ - low_) / 8));
            for (double power = low_; power <= high_ + 1e-9; power += stride)
                out.push_back(std::pow(10, power));
            return out;
        }
        const double rough = (high_ - low_) / 6, unit = std::pow(10, std::floor(std::log10(rough)));
        double step = 10 * unit;
        for (double candidate : {unit, 2 * unit, 5 * unit})
            if (candidate >= rough) {
                step = candidate;
                break;
            }
        for (double v = std::ceil(low_ / step) * step; v <= high_ + 1e-9 * step; v += step)
            out.push_back(v);
        return out;
    }

  private:
    [[nodiscard]] double of(double value) const { return log_ ? std::log10(value) : value; }
    bool log_;
    double from_, to_, low_ = 0, high_ = 1;
};

std::string text(double x, double y, const char* anchor, const std::string& words) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>", x, y, anchor,
                       escaped(words));
}

/// Names beside points: where there is room for one, or not at all (the pointer finds it).
class Names {
  public:
    explicit Names(const Plot& plot, const Axis& x, const Axis& y) {
        for (const PlotSeries& series : plot.series)
            for (const PlotPoint& p : series.points)
                if (!p.name.empty()) taken_.push_back({x.at(p.x) - 4, y.at(p.y) - 4, 8, 8});
    }
    std::string beside(double x, double y, const std::string& name) {
        constexpr double letter = 6, line = 12;  // px, about
        const double wide = letter * static_cast<double>(name.size());
        for (const double down : {-5.0, 14.0, -17.0, 26.0})
            for (const bool onRight : {true, false}) {
                const Box box{onRight ? x + 6 : x - 6 - wide, y + down - line + 2, wide, line};
                if (box.x < left || box.x + wide > width || box.y < top || box.y + line > height - bottom ||
                    std::any_of(taken_.begin(), taken_.end(), [&](const Box& b) { return b.meets(box); }))
                    continue;
                taken_.push_back(box);
                return text(onRight ? x + 6 : x - 6, y + down, onRight ? "start" : "end", name);
            }
        return "";
    }

  private:
    struct Box {
        double x, y, wide, high;
        [[nodiscard]] bool meets(const Box& b) const {
            return x < b.x + b.wide && b.x < x + wide && y < b.y + b.high && b.y < y + high;
        }
    };
    std::vector<Box> taken_;
};

std::string drawn(const PlotSeries& series, const Axis& x, const Axis& y, const char* colour, Names& names) {
    std::string out;
    if (series.joined && series.points.size() > 1) {
        out += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\" points=\"", colour);
        for (const PlotPoint& p : series.points)
            out += fmt::format("{:.1f},{:.1f} ", x.at(p.x), y.at(p.y));
        out += "\"/>";
    }
    constexpr size_t mostDots = 60;  // a curve of hundreds of points is a line
    if (series.points.size() > mostDots) return out;
    for (const PlotPoint& p : series.points) {
        if (!p.name.empty()) out += names.beside(x.at(p.x), y.at(p.y), p.name);
        out += fmt::format(
            "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"><title>{}</title></circle>", x.at(p.x),
            y.at(p.y), colour, escaped(p.label));
    }
    return out;
}

}  // namespace

std::string escaped(std::string_view raw) {
    std::string out;
    for (char c : raw) {
        if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '&')
            out += "&amp;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

std::string svgOf(const Plot& plot) {
    std::vector<double> xs, ys;
    for (const PlotSeries& series : plot.series)
        for (const PlotPoint& p : series.points) {
            xs.push_back(p.x);
            ys.push_back(p.y);
        }
    if (xs.empty()) return "";
    const Axis x(xs, plot.logX, false, left, width - right), y(ys, plot.logY, true, height - bottom, top);
    std::string out =
        fmt::format("<svg viewBox=\"0 0 {} {}\" width=\"{}\" height=\"{}\" role=\"img\" aria-label=\"{}\">",
                    width, height, width, height, escaped(plot.title));
    out += "<g class=\"title\">" + text(left, 18, "start", plot.title) + "</g>";
    for (double v : x.ticks())
        out += fmt::format("<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>",
                           x.at(v), top, height - bottom) +
               text(x.at(v), height - bottom + 15, "middle", rounded(v, 4));
    for (double v : y.ticks())
        out += fmt::format("<line class=\"grid\" x1=\"{1}\" x2=\"{2}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\"/>",
                           y.at(v), left, width - right) +
               text(left - 6, y.at(v) + 4, "end", rounded(v, 4));
    out += text((left + width - right) / 2, height - 10, "middle", plot.xLabel);
    out +=
        fmt::format("<text transform=\"translate(16 {:.0f}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
                    (top + height - bottom) / 2, escaped(plot.yLabel));
    Names names(plot, x, y);
    for (size_t i = 0; i < plot.series.size(); ++i) {
        const char* colour = colours[i % colours.size()];
        out += drawn(plot.series[i], x, y, colour, names);
        const double line = top + 8 + 17 * static_cast<double>(i);
        out += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"4\" fill=\"{}\"/>", width - right + 16, line,
                           colour) +
               text(width - right + 25, line + 4, "start", plot.series[i].name);
    }
    return out + "</svg>\n";
}

}  // namespace spectrad
