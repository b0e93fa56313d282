// CIE daylight illuminants (CIE 015:2018, 4.1.2 and table 6): a mean spectrum and two components, weighted by
// chromaticity.
#include "base/error.h"
#include "base/text.h"
#include "spectrum/curve.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace spectrad {

namespace {

constexpr double firstNm = 300, stepNm = 10;

/// S0, S1, S2 at 300, 310 … 830 nm. The CIE's 5 nm table is the linear interpolation of this one.
constexpr std::array<std::array<double, 3>, 54> components{{
    {0.04, 0.02, 0},     {6, 4.5, 2},         {29.6, 22.4, 4},     {55.3, 42, 8.5},     {57.3, 40.6, 7.8},
    {61.8, 41.6, 6.7},   {61.5, 38, 5.3},     {68.8, 42.4, 6.1},   {63.4, 38.5, 3},     {65.8, 35, 1.2},
    {94.8, 43.4, -1.1},  {104.8, 46.3, -0.5}, {105.9, 43.9, -0.7}, {96.8, 37.1, -1.2},  {113.9, 36.7, -2.6},
    {125.6, 35.9, -2.9}, {125.5, 32.6, -2.8}, {121.3, 27.9, -2.6}, {121.3, 24.3, -2.6}, {113.5, 20.1, -1.8},
    {113.1, 16.2, -1.5}, {110.8, 13.2, -1.3}, {106.5, 8.6, -1.2},  {108.8, 6.1, -1},    {105.3, 4.2, -0.5},
    {104.4, 1.9, -0.3},  {100, 0, 0},         {96, -1.6, 0.2},     {95.1, -3.5, 0.5},   {89.1, -3.5, 2.1},
    {90.5, -5.8, 3.2},   {90.3, -7.2, 4.1},   {88.4, -8.6, 4.7},   {84, -9.5, 5.1},     {85.1, -10.9, 6.7},
    {81.9, -10.7, 7.3},  {82.6, -12, 8.6},    {84.9, -14, 9.8},    {81.3, -13.6, 10.2}, {71.9, -12, 8.3},
    {74.3, -13.3, 9.6},  {76.4, -12.9, 8.5},  {63.3, -10.6, 7},    {71.7, -11.6, 7.6},  {77, -12.2, 8},
    {65.2, -10.2, 6.7},  {47.7, -7.8, 5.2},   {68.6, -11.2, 7.4},  {65, -10.4, 6.8},    {66, -10.6, 7},
    {61, -9.7, 6.4},     {53.3, -8.3, 5.5},   {58.9, -9.3, 6.1},   {61.9, -9.8, 6.5},
}};

double toThreeDecimals(double value) {
    return std::round(value * 1000) / 1000;
}

}  // namespace

Curve Curve::daylight(double kelvin) {
    if (!(kelvin >= 4000 && kelvin <= 25'000))
        throw InputError(fmt::format("daylight of {} K (allowed: 4000 … 25000 K)", shortest(kelvin)));
    const double t = 1000 / kelvin;
    const double x = kelvin <= 7000 ? ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244063
                                    : ((-2.0064 * t + 1.9018) * t + 0.24748) * t + 0.237040;
    const double y = (-3.000 * x + 2.870) * x - 0.275;
    const double m = 0.0241 + 0.2562 * x - 0.7341 * y;
    // Rounded as the CIE rounds them; its tables of D50, D55, D65 and D75 come out so and not otherwise.
    const double m1 = toThreeDecimals((-1.3515 - 1.7703 * x + 5.9114 * y) / m);
    const double m2 = toThreeDecimals((0.0300 - 31.4424 * x + 30.0717 * y) / m);
    std::vector<double> nm, value;
    for (size_t i = 0; i < components.size(); ++i) {
        nm.push_back(firstNm + stepNm * static_cast<double>(i));
        value.push_back(components[i][0] + m1 * components[i][1] + m2 * components[i][2]);
    }
    return table(std::move(nm), std::move(value));
}

}  // namespace spectrad
