// The spot meter and its plots.
#include "base/text.h"
#include "colour/display.h"
#include "viewer/panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <utility>

namespace spectrad::view {

namespace {

constexpr double violet = 380, red = 730;  // nm: what plots without a range of their own show

/// About the colour of a wavelength, for people to find their way: sRGB, brightest channel 1.
ImU32 colourOf(double nm, float alpha) {
    // Gaussian lobes fitted to the CIE 1931 observer (Wyman, Sloan & Shirley 2013).
    // Beyond these the fit strays, and the eye sees no other hue.
    const double seen = std::clamp(nm, 405.0, 690.0);
    const auto lobe = [nm = seen](double mean, double below, double above) {
        const double t = (nm - mean) / (nm < mean ? below : above);
        return std::exp(-0.5 * t * t);
    };
    const Triple xyz{
        1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7) - 0.065 * lobe(501.1, 20.4, 26.2),
        0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
        1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8)};
    static const Display srgb = srgbDisplay();
    Triple rgb = srgb.fromXyz * xyz;
    double most = 1e-6;
    for (double& c : rgb) {
        c = std::max(c, 0.0);
        most = std::max(most, c);
    }
    const double dim = std::clamp(std::min((nm - 370) / 40, (760 - nm) / 60), 0.35, 1.0);
    return ImGui::ColorConvertFloat4ToU32({static_cast<float>(encode(srgb, dim * rgb[0] / most)),
                                           static_cast<float>(encode(srgb, dim * rgb[1] / most)),
                                           static_cast<float>(encode(srgb, dim * rgb[2] / most)), alpha});
}

struct Frame {
    ImVec2 from, to;
    double low, high, top;
    [[nodiscard]] ImVec2 at(double nm, double value) const {
        return {from.x + static_cast<float>((nm - low) / (high - low)) * (to.x - from.x),
                to.y - static_cast<float>(std::clamp(value / top, 0.0, 1.0)) * (to.y - from.y - 3)};
    }
};

Frame beginPlot(const char* id, float width, float height, double low, double high, double top) {
    const ImVec2 from = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton(id, {width, height});
    const Frame frame{
        from, {from.x + width, from.y + height}, low, std::max(high, low + 1), top > 0 ? top : 1};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(frame.from, frame.to, IM_COL32(22, 22, 25, 255), 3);
    for (double nm = std::ceil(low / 100) * 100; nm <= high; nm += 100)
        list.AddLine(frame.at(nm, 0), {frame.at(nm, 0).x, frame.from.y}, IM_COL32(255, 255, 255, 22));
    return frame;
}

void drawLine(const Frame& frame, const std::vector<double>& nm, const std::vector<double>& value,
              ImU32 colour, float thick) {
    std::vector<ImVec2> points;
    for (size_t i = 0; i < nm.size() && i < value.size(); ++i)
        points.push_back(frame.at(nm[i], value[i]));
    ImGui::GetWindowDrawList()->AddPolyline(points.data(), static_cast<int>(points.size()), colour, 0, thick);
}

void fill(const Frame& frame, const std::vector<double>& nm, const std::vector<double>& value) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    // Smoothed edges would show as seams between the columns.
    const ImDrawListFlags flags = std::exchange(list.Flags, list.Flags & ~ImDrawListFlags_AntiAliasedFill);
    for (size_t i = 0; i + 1 < nm.size() && i + 1 < value.size(); ++i) {
        const ImVec2 a = frame.at(nm[i], value[i]), b = frame.at(nm[i + 1], value[i + 1]);
        list.AddQuadFilled({a.x, frame.to.y}, a, b, {b.x, frame.to.y},
                           colourOf(0.5 * (nm[i] + nm[i + 1]), 0.75f));
    }
    list.Flags = flags;
}

double largest(const std::vector<double>& values) {
    return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

void drawSpectra(Session& session, PanelState& state, float width) {
    const std::vector<double>& nm = session.about().wavelengths().nm;
    double top = state.meter ? largest(state.meter->spectrum) : 0;
    for (const Pin& pin : session.pins)
        top = std::max(top, largest(pin.spectrum));
    const Frame frame = beginPlot("##spectrum", width, 110 * state.scale, nm.front(), nm.back(), 1.05 * top);
    if (state.meter) fill(frame, nm, state.meter->spectrum);
    for (size_t i = 0; i < session.pins.size(); ++i)
        drawLine(frame, nm, session.pins[i].spectrum, pinColour(i), 1.5f * state.scale);
    if (state.meter) drawLine(frame, nm, state.meter->spectrum, IM_COL32_WHITE, 1.2f * state.scale);
    ImGui::TextDisabled("%.0f nm", nm.front());
    const std::string right = fmt::format("{:.0f} nm", nm.back());
    ImGui::SameLine(width - ImGui::CalcTextSize(right.c_str()).x + ImGui::GetStyle().WindowPadding.x);
    ImGui::TextDisabled("%s", right.c_str());
}

void drawChromaticities(Session& session, PanelState& state, float width) {
    constexpr double side = 0.86;  // of the diagram: x and y from 0
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float height = width * 0.86f;
    ImGui::InvisibleButton("##xy", {width, height});
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(from, {from.x + width, from.y + height}, IM_COL32(22, 22, 25, 255), 3);
    const auto at = [&](double x, double y) {
        return ImVec2{from.x + static_cast<float>((x + 0.02) / side) * width,
                      from.y + height - static_cast<float>((y + 0.02) / (side + 0.02)) * height};
    };
    for (size_t i = 0; i + 1 < state.horseshoe.size(); ++i)
        list.AddLine(at(state.horseshoe[i][0], state.horseshoe[i][1]),
                     at(state.horseshoe[i + 1][0], state.horseshoe[i + 1][1]),
                     colourOf(390 + 2 * static_cast<double>(i), 1), 2 * state.scale);
    list.AddLine(at(state.horseshoe.front()[0], state.horseshoe.front()[1]),
                 at(state.horseshoe.back()[0], state.horseshoe.back()[1]), IM_COL32(150, 90, 150, 160),
                 1.5f * state.scale);
    std::vector<ImVec2> planck;
    for (double mired = 40; mired <= 1000; mired += 20) {
        const auto [u, v] = state.locus->at(1e6 / mired);
        const double d = 2 * u - 8 * v + 4;  // CIE 1960 u, v to x, y
        planck.push_back(at(3 * u / d, 2 * v / d));
    }
    list.AddPolyline(planck.data(), static_cast<int>(planck.size()), IM_COL32(200, 200, 200, 120), 0,
                     1.2f * state.scale);
    // The triangle that the display can show.
    std::array<ImVec2, 3> corner;
    for (size_t i = 0; i < 3; ++i) {
        Triple unit{};
        unit[i] = 1;
        const auto xy = chromaticity(session.displayFor(session.look(session.edited)).toXyz * unit);
        corner[i] = at((*xy)[0], (*xy)[1]);
    }
    list.AddTriangle(corner[0], corner[1], corner[2], IM_COL32(255, 255, 255, 90));
    const auto dot = [&](const Triple& xyz, ImU32 colour, float radius) {
        if (const auto xy = chromaticity(xyz)) {
            list.AddCircleFilled(at((*xy)[0], (*xy)[1]), radius * state.scale, colour);
            list.AddCircle(at((*xy)[0], (*xy)[1]), (radius + 1) * state.scale, IM_COL32(0, 0, 0, 200));
        }
    };
    for (size_t i = 0; i < session.pins.size(); ++i)
        dot(session.pins[i].xyz, pinColour(i), 3.5f);
    if (state.meter) dot(state.meter->xyz, IM_COL32_WHITE, 4);
}

void drawFigures(const Pin& pin, const PanelState& state) {
    ImGui::Text("%.4g cd/m²", pin.xyz[1]);
    ImGui::SameLine();
    ImGui::TextDisabled("at %d,%d", pin.x, pin.y);
    ImGui::TextDisabled("XYZ");
    ImGui::SameLine();
    ImGui::Text("%.4g  %.4g  %.4g", pin.xyz[0], pin.xyz[1], pin.xyz[2]);
    if (const auto xy = chromaticity(pin.xyz)) {
        ImGui::TextDisabled("xy");
        ImGui::SameLine();
        ImGui::Text("%.4f  %.4f", (*xy)[0], (*xy)[1]);
        if (const std::optional<Cct> cct = state.locus->nearest(pin.xyz)) {
            ImGui::SameLine();
            ImGui::TextDisabled(" CCT");
            ImGui::SameLine();
            ImGui::Text("%.0f K", cct->kelvin);
        }
    }
}

}  // namespace

std::uint32_t pinColour(size_t number) {
    static constexpr std::array<ImU32, 6> colours{IM_COL32(255, 190, 90, 255),  IM_COL32(120, 200, 255, 255),
                                                  IM_COL32(160, 230, 130, 255), IM_COL32(240, 140, 200, 255),
                                                  IM_COL32(200, 170, 255, 255), IM_COL32(240, 240, 120, 255)};
    return colours[number % colours.size()];
}

void sampled(const Curve& curve, std::vector<double>& nm, std::vector<double>& value) {
    nm.clear();
    value.clear();
    constexpr double step = 2;
    for (double at = violet; at <= red; at += step) {
        nm.push_back(at);
        value.push_back(curve.at(at));
    }
    // A line's integral as a peak of the plot's own width.
    for (const SpectralLine& line : curve.lines())
        if (line.nm >= violet && line.nm <= red)
            value[static_cast<size_t>(std::lround((line.nm - violet) / step))] += line.integral / step;
}

void plotSpectrum(const char* id, const std::vector<double>& nm, const std::vector<double>& value,
                  float width, float height) {
    if (nm.empty()) return;
    const Frame frame = beginPlot(id, width, height, nm.front(), nm.back(), 1.05 * largest(value));
    fill(frame, nm, value);
    drawLine(frame, nm, value, IM_COL32(235, 235, 235, 255), 1.2f);
}

void drawMeter(Session& session, PanelState& state, float width) {
    ImGui::TextDisabled("Spot meter");
    drawSpectra(session, state, width);
    if (state.meter)
        drawFigures(*state.meter, state);
    else
        ImGui::TextDisabled("no pixel under the pointer");
    drawChromaticities(session, state, width);
    size_t remove = session.pins.size();
    for (size_t i = 0; i < session.pins.size(); ++i) {
        const Pin& pin = session.pins[i];
        ImGui::PushID(static_cast<int>(i));
        ImGui::ColorButton("##colour", ImGui::ColorConvertU32ToFloat4(pinColour(i)),
                           ImGuiColorEditFlags_NoTooltip, {10 * state.scale, 10 * state.scale});
        ImGui::SameLine();
        ImGui::Text("%d,%d  %.4g cd/m²", pin.x, pin.y, pin.xyz[1]);
        ImGui::SameLine();
        if (ImGui::SmallButton("×")) remove = i;
        ImGui::PopID();
    }
    if (remove < session.pins.size())
        session.pins.erase(session.pins.begin() + static_cast<std::ptrdiff_t>(remove));
}

}  // namespace spectrad::view
