// A curve drawn with block characters, for a look at a spectrum in the terminal.
#include "base/text.h"
#include "cli/info.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace spectrad {

namespace {

constexpr size_t columns = 72, rows = 8;
constexpr std::array<const char*, 9> blocks{" ", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};

/// The largest value in each column's interval, so that a narrow line is not lost between two columns.
std::array<double, columns> peaks(const Curve& curve, double from, double to) {
    constexpr int steps = 16;
    std::array<double, columns> out{};
    for (size_t column = 0; column < columns; ++column) {
        const double start = from + (to - from) * static_cast<double>(column) / columns;
        out[column] = curve.at(start);
        for (int step = 1; step <= steps; ++step)
            out[column] = std::max(out[column], curve.at(start + (to - from) / columns * step / steps));
    }
    return out;
}

}  // namespace

std::string plot(const Curve& curve, double from, double to) {
    const std::array<double, columns> values = peaks(curve, from, to);
    const double low = std::min(0.0, *std::min_element(values.begin(), values.end()));
    double high = std::max(0.0, *std::max_element(values.begin(), values.end()));
    if (high == low) high = low + 1;

    std::array<double, columns> height{};  // in rows
    for (size_t column = 0; column < columns; ++column)
        height[column] = (values[column] - low) / (high - low) * rows;
    for (const SpectralLine& line : curve.lines())
        if (line.nm >= from && line.nm <= to)
            height[std::min(columns - 1, static_cast<size_t>((line.nm - from) / (to - from) * columns))] =
                rows;

    std::string out;
    for (size_t row = rows; row-- > 0;) {
        const std::string label = row == rows - 1 ? rounded(high, 4) : row == 0 ? rounded(low, 4) : "";
        out += fmt::format("{:>11} │", label);
        for (double h : height) {
            const double filled = std::clamp((h - static_cast<double>(row)) * 8, 0.0, 8.0);
            out += blocks[static_cast<size_t>(std::lround(filled))];
        }
        out += '\n';
    }
    const std::string left = rounded(from, 6), right = rounded(to, 6) + " nm";
    return out + fmt::format("{:>12}{}{:>{}}\n", "", left, right, columns + 1 - left.size());
}

}  // namespace spectrad
