// A panel is two plots over one axis: the distribution as steps, in percent of the cells, and below it the accumulated
// distribution as a line. Each curve is of 100 % by itself, so that few cells compare with many. Coordinates are pixels
// from the upper left corner.
#include "files/quality/quality_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/number_text.h"
#include "base/core/xml_text.h"
#include "files/quality/inside/histogram_rows.h"
#include "files/quality/quality_text.h"

namespace kerf {

namespace {

namespace sheet {

// Colours that the colour-blind can tell apart.
constexpr const char *grey = "#666666", *blue = "#0072b2", *orange = "#d55e00";

struct Curve {
    std::string name;
    const char* colour;
    const Distribution* distribution;
    bool is_dashed = false;  // in the accumulated plot
};

struct Panel {
    Measure measure;
    const char* counted;        // things that the distribution counts
    std::vector<Curve> curves;  // one or more, none of which is empty
};

struct LegendEntry {
    const char* colour;
    std::string text;
};

// Returns the end of a long path, without a character that is cut in two.
std::string shortened(const std::string& name) {
    constexpr std::size_t most = 90;
    if (name.size() <= most) return name;
    std::size_t begin = name.size() - most;
    while (begin < name.size() && (static_cast<unsigned char>(name[begin]) & 0xc0) == 0x80) ++begin;
    return "\u2026" + name.substr(begin);
}

struct Frame {
    double left, top, width, height;
    double right() const { return left + width; }
    double bottom() const { return top + height; }
};

class Drawing {
 public:
    void line(double x1, double y1, double x2, double y2, const char* colour) {
        body_ +=
            fmt::format("<path d='M{:.2f} {:.2f}L{:.2f} {:.2f}' stroke='{}' fill='none'/>\n", x1, y1, x2, y2, colour);
    }
    /// `style` is more attributes, as the size of the font or the anchor.
    void text(double x, double y, const std::string& content, const char* style) {
        body_ += fmt::format("<text x='{:.2f}' y='{:.2f}' {}>{}</text>\n", x, y, style, content);
    }
    void upright_text(double x, double y, const std::string& content) {
        body_ += fmt::format(
            "<text transform='translate({:.2f} {:.2f}) rotate(-90)' font-size='11' text-anchor='middle' "
            "fill='#444444'>{}</text>\n",
            x, y, content);
    }
    void path(const std::string& data, const std::string& style) {
        body_ += fmt::format("<path d='{}' {}/>\n", data, style);
    }
    void box(const Frame& frame) {
        body_ +=
            fmt::format("<rect x='{:.2f}' y='{:.2f}' width='{:.2f}' height='{:.2f}' fill='none' stroke='#888888'/>\n",
                        frame.left, frame.top, frame.width, frame.height);
    }
    void swatch(double x, double y, const char* colour) {
        body_ += fmt::format(
            "<rect x='{:.2f}' y='{:.2f}' width='22' height='10' fill='{}' fill-opacity='0.35' stroke='{}' "
            "stroke-width='1.5'/>\n",
            x, y, colour, colour);
    }
    std::string finish(double width, double height) const {
        return fmt::format(
            "<?xml version='1.0' encoding='UTF-8'?>\n"
            "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 {0:.0f} {1:.0f}' "
            "font-family='DejaVu Sans, Verdana, Arial, sans-serif' font-size='12' fill='#222222'>\n"
            "<rect width='{0:.0f}' height='{1:.0f}' fill='#ffffff'/>"
            "\n{2}</svg>\n",
            width, height, body_);
    }

 private:
    std::string body_;
};

// Returns the step 1, 2 or 5 times a power of ten that divides a length into `most` pieces or less.
double round_step(double length, int most) {
    const double least = length / most, power = std::pow(10, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= least * (1 - 1e-9)) return factor * power;
    return 10 * power;
}

std::vector<double> linear_ticks(double low, double high, int most) {
    const double step = round_step(high - low, most);
    std::vector<double> ticks;
    for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
        ticks.push_back(k * step + 0.0);  // no -0
    return ticks;
}

// Returns powers of ten and, over short ranges, round numbers between them.
std::vector<double> logarithmic_ticks(double low, double high) {
    static const std::vector<double> fine = {1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8}, middle = {1, 1.5, 2, 3, 4, 5, 7},
                                     coarse = {1, 2, 5}, powers = {1};
    const double decades = std::log10(high / low);
    const std::vector<double>& factors = decades < 0.8 ? fine : decades < 1.6 ? middle : decades < 3 ? coarse : powers;
    const int stride = 1 + static_cast<int>(decades / 9);
    std::vector<double> ticks;
    for (int power = std::floor(std::log10(low)); power <= std::log10(high); power += stride)
        for (const double factor : factors) {
            const double tick = factor * std::pow(10, power);
            if (tick >= low && tick <= high) ticks.push_back(tick);
        }
    if (ticks.size() < 2) return {low, high};
    return ticks;
}

// Maps values to pixels.
class Axis {
 public:
    Axis(Distribution::Scale scale, double low, double high, double left, double width)
        : is_linear_(scale == Distribution::Scale::linear), low_(low), high_(high), left_(left), width_(width) {}
    double place(double value) const {
        const double part =
            is_linear_ ? (value - low_) / (high_ - low_) : std::log(value / low_) / std::log(high_ / low_);
        return left_ + width_ * part;
    }
    std::vector<double> ticks() const {
        constexpr int most = 10;
        return is_linear_ ? linear_ticks(low_, high_, most) : logarithmic_ticks(low_, high_);
    }

 private:
    bool is_linear_;
    double low_, high_, left_, width_;
};

// A curve in percent: of each interval, and accumulated at each edge.
struct Percentages {
    std::vector<double> edges, in_interval, accumulated;
};

Percentages percentages(const Distribution& distribution, const HistogramRows& rows) {
    const Distribution::Histogram histogram = distribution.histogram(rows.first, rows.group, rows.groups);
    const double percent = 100.0 / distribution.count();
    Percentages result{histogram.edges, {}, {}};
    std::int64_t below = rows.first > 0 ? distribution.histogram(0, rows.first, 1).counts.front() : 0;
    result.accumulated.push_back(percent * below);
    for (const std::int64_t count : histogram.counts) {
        below += count;
        result.in_interval.push_back(percent * count);
        result.accumulated.push_back(percent * below);
    }
    return result;
}

std::string unit_text(const Measure& measure) {
    const std::string_view unit = measure.unit;
    return unit == "deg" ? "\u00b0" : unit == "length^3" ? "length\u00b3" : std::string(unit);
}

// Returns the width of the steps: in the unit, or by which part the next edge is larger.
std::string interval_text(const Panel& panel, const std::vector<double>& edges) {
    const bool is_linear = panel.curves.front().distribution->scale() == Distribution::Scale::linear;
    if (is_linear) return fmt::format("intervals of {:.4g}{}", edges[1] - edges[0], unit_text(panel.measure));
    return fmt::format("intervals of {:.2g} %", 100 * (edges[1] / edges[0] - 1));
}

// Draws the title, and the worst and the middle cell of each curve.
void draw_head(Drawing& drawing, const Panel& panel, const std::vector<double>& edges, const Frame& frame) {
    const std::string unit = unit_text(panel.measure);
    std::string title = panel.measure.title;
    title.front() = static_cast<char>(title.front() - 'a' + 'A');
    drawing.text(frame.left, frame.top - 25, unit.empty() ? title : title + ", " + unit,
                 "font-size='14' font-weight='bold'");
    drawing.text(frame.right(), frame.top - 25, interval_text(panel, edges),
                 "font-size='11' text-anchor='end' fill='#777777'");
    std::string numbers = "worst, median:";
    for (const Curve& curve : panel.curves) {
        const double worst = panel.measure.small_is_bad ? curve.distribution->min() : curve.distribution->max();
        numbers +=
            fmt::format("{} <tspan fill='{}'>{} {}, {}</tspan>", &curve == &panel.curves.front() ? "" : " \u00b7",
                        curve.colour, curve.name, four_digits(worst), four_digits(curve.distribution->percentile(0.5)));
    }
    drawing.text(frame.left, frame.top - 8, numbers, "font-size='11' fill='#777777'");
}

// Draws lines across the frame at round percentages, with numbers at their left.
void draw_percent_axis(Drawing& drawing, const Frame& frame, double highest, int most, const std::string& name) {
    for (const double tick : linear_ticks(0, highest, most)) {
        const double y = frame.bottom() - frame.height * tick / highest;
        drawing.line(frame.left, y, frame.right(), y, "#e3e3e3");
        drawing.text(frame.left - 6, y + 4, four_digits(tick), "font-size='11' text-anchor='end'");
    }
    drawing.upright_text(frame.left - 44, frame.top + frame.height / 2, name);
}

void draw_value_axis(Drawing& drawing, const Axis& axis, const Frame& upper, const Frame& lower) {
    for (const double tick : axis.ticks()) {
        const double x = axis.place(tick);
        drawing.line(x, upper.top, x, upper.bottom(), "#e3e3e3");
        drawing.line(x, lower.top, x, lower.bottom() + 4, "#e3e3e3");
        drawing.text(x, lower.bottom() + 17, four_digits(tick), "font-size='11' text-anchor='middle'");
    }
}

void draw_steps(Drawing& drawing, const Axis& axis, const Frame& frame, const Percentages& values, double highest,
                const Curve& curve) {
    const auto y_of = [&](double percent) { return frame.bottom() - frame.height * percent / highest; };
    std::string path = fmt::format("M{:.2f} {:.2f}", axis.place(values.edges.front()), frame.bottom());
    for (std::size_t i = 0; i < values.in_interval.size(); ++i)
        path += fmt::format("V{:.2f}H{:.2f}", y_of(values.in_interval[i]), axis.place(values.edges[i + 1]));
    path += fmt::format("V{:.2f}", frame.bottom());
    drawing.path(path, fmt::format("fill='{0}' fill-opacity='0.18' stroke='{0}' stroke-width='1.3'", curve.colour));
}

void draw_accumulated(Drawing& drawing, const Axis& axis, const Frame& frame, const Percentages& values,
                      const Curve& curve) {
    std::string path;
    for (std::size_t i = 0; i < values.edges.size(); ++i)
        path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? "M" : "L", axis.place(values.edges[i]),
                            frame.bottom() - frame.height * values.accumulated[i] / 100);
    drawing.path(path, fmt::format("fill='none' stroke='{}' stroke-width='1.8'{}", curve.colour,
                                   curve.is_dashed ? " stroke-dasharray='7 4'" : ""));
}

void draw_panel(Drawing& drawing, const Panel& panel, const Frame& upper, const Frame& lower) {
    std::vector<const Distribution*> distributions;
    for (const Curve& curve : panel.curves) distributions.push_back(curve.distribution);
    const HistogramRows rows = choose_rows(distributions, {.most = 90, .tail = 0.0002, .least_bins = 24});
    std::vector<Percentages> values;
    double highest = 0;
    for (const Distribution* distribution : distributions) {
        values.push_back(percentages(*distribution, rows));
        highest =
            std::max(highest, *std::max_element(values.back().in_interval.begin(), values.back().in_interval.end()));
    }
    constexpr int percent_ticks = 5;
    const double step = round_step(highest, percent_ticks), top = step * std::ceil(highest / step + 0.05);
    const Axis axis(distributions.front()->scale(), values.front().edges.front(), values.front().edges.back(),
                    upper.left, upper.width);
    draw_head(drawing, panel, values.front().edges, upper);
    draw_percent_axis(drawing, upper, top, percent_ticks + 1, fmt::format("% of {}", panel.counted));
    draw_percent_axis(drawing, lower, 100, 4, "% below");
    draw_value_axis(drawing, axis, upper, lower);
    for (std::size_t i = 0; i < values.size(); ++i) {
        draw_steps(drawing, axis, upper, values[i], top, panel.curves[i]);
        draw_accumulated(drawing, axis, lower, values[i], panel.curves[i]);
    }
    drawing.box(upper);
    drawing.box(lower);
}

std::string draw(const std::string& title, const std::vector<LegendEntry>& legend, const std::vector<Panel>& panels) {
    constexpr double margin = 70, plot_width = 520, upper_height = 190, lower_height = 110, gap = 18,
                     panel_height = 430;
    constexpr std::size_t columns = 2;
    const double head_height = 90 + 22 * legend.size();
    const double lines = (panels.size() + columns - 1) / columns;
    Drawing drawing;
    drawing.text(margin, 44, title, "font-size='22' font-weight='bold'");
    for (std::size_t i = 0; i < legend.size(); ++i) {
        const double y = 70 + 22 * i;
        drawing.swatch(margin, y - 9, legend[i].colour);
        drawing.text(margin + 32, y, xml_text(legend[i].text), "font-size='13'");
    }
    drawing.text(margin, head_height - 18,
                 "Above: how many in each interval. Below: how many have less. Each curve is of its own 100 %.",
                 "fill='#777777'");
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const double column = i % columns, line = i / columns;
        const double left = margin + column * (plot_width + margin + 20), top = head_height + line * panel_height + 50;
        const Frame upper{left, top, plot_width, upper_height};
        draw_panel(drawing, panels[i], upper, {left, upper.bottom() + gap, plot_width, lower_height});
    }
    return drawing.finish(columns * (plot_width + margin) + 20 + 30, head_height + lines * panel_height + 10);
}

void add_curve(Panel& panel, const char* name, const char* colour, const Distribution& distribution,
               bool is_dashed = false) {
    if (distribution.count() > 0) panel.curves.push_back({name, colour, &distribution, is_dashed});
}

std::string counts_text(const MeshQuality& quality) {
    return fmt::format("{} \u2013 {} tetrahedra, {} vertices{}", shortened(quality.name), grouped(quality.tets()),
                       grouped(quality.vertices), quality.parts > 1 ? fmt::format(", {} parts", quality.parts) : "");
}

}  // namespace sheet

}  // namespace

std::string quality_sheet(const MeshQuality& quality) {
    const auto& [all, interface, interior, angles] = quality.cells;
    std::vector<sheet::Panel> panels;
    const bool has_interface = interface.measures.front().count() > 0;
    for (std::size_t i = 0; i < quality_measures.size(); ++i) {
        sheet::Panel& panel = panels.emplace_back(sheet::Panel{quality_measures[i], "cells", {}});
        sheet::add_curve(panel, "all", sheet::grey, all.measures[i]);
        if (!has_interface) continue;
        sheet::add_curve(panel, "interface", sheet::orange, interface.measures[i]);
        sheet::add_curve(panel, "interior", sheet::blue, interior.measures[i]);
    }
    for (std::size_t i = 0; i < triangle_measures.size(); ++i) {
        sheet::Panel panel{triangle_measures[i], "triangles", {}};
        sheet::add_curve(panel, "all", sheet::grey, quality.boundary.measures[i]);
        if (!panel.curves.empty()) panels.push_back(std::move(panel));
    }
    const auto count_of = [](const QualityDistributions& cells) { return grouped(cells.measures.front().count()); };
    std::vector<sheet::LegendEntry> legend = {{sheet::grey, sheet::counts_text(quality)}};
    if (has_interface) {
        legend.push_back({sheet::orange, count_of(interface) + " cells with a vertex on an interface"});
        legend.push_back({sheet::blue, count_of(interior) + " other cells"});
    }
    return sheet::draw("Quality of a mesh", legend, panels);
}

std::string comparison_sheet(const MeshQuality& first, const MeshQuality& second) {
    std::vector<sheet::Panel> panels;
    const auto compare = [&](const Measure& measure, const char* counted, const Distribution& a,
                             const Distribution& b) {
        if (!a.has_range_of(b))
            throw Error(ErrorCode::internal, "Meshes that were measured with different length scales are compared.");
        sheet::Panel panel{measure, counted, {}};
        sheet::add_curve(panel, "A", sheet::blue, a);
        sheet::add_curve(panel, "B", sheet::orange, b, true);
        if (!panel.curves.empty()) panels.push_back(std::move(panel));
    };
    for (std::size_t i = 0; i < quality_measures.size(); ++i)
        compare(quality_measures[i], "cells", first.cells.all.measures[i], second.cells.all.measures[i]);
    for (std::size_t i = 0; i < triangle_measures.size(); ++i)
        compare(triangle_measures[i], "triangles", first.boundary.measures[i], second.boundary.measures[i]);
    return sheet::draw(
        "Quality of two meshes",
        {{sheet::blue, "A: " + sheet::counts_text(first)}, {sheet::orange, "B: " + sheet::counts_text(second)}},
        panels);
}

}  // namespace kerf
