// SPDX-License-Identifier: MIT
#include "effects/assets/image/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace kaamos::effects {
namespace {

constexpr double kWidth = 900, kHeight = 600;
constexpr double kLeft = 84, kRight = 660, kTop = 66, kBottom = 528;
constexpr double kCharacter = 5.9;  // approximate width of a character at 11 px
// Colours that colour-blind people can tell apart. [Okabe & Ito]
constexpr std::array kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                "#000000", "#56b4e9", "#e69f00", "#8c510a"};

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof text, pattern, arguments);
  va_end(arguments);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') out += "&amp;";
    if (c == '<') out += "&lt;";
    if (c == '>') out += "&gt;";
    if (c == '"') out += "&quot;";
    // XML does not allow other control characters.
    if (c != '&' && c != '<' && c != '>' && c != '"')
      out += static_cast<unsigned char>(c) < 32 ? ' ' : c;
  }
  return out;
}

bool has_place(double x, double y) {
  return std::isfinite(x) && std::isfinite(y) && x > 0 && y > 0;
}

// Maps values to positions along one axis.
class Axis {
 public:
  void include(double value) {
    low_ = std::min(low_, std::log10(value));
    high_ = std::max(high_, std::log10(value));
  }
  // Leaves a margin around the values, and makes a range even of a single one.
  void finish(double from, double to) {
    if (low_ > high_) low_ = high_ = 0;
    const double room = std::max(0.08 * (high_ - low_), 0.1);
    low_ -= room;
    high_ += room;
    from_ = from;
    to_ = to;
  }
  double place(double value) const {
    return from_ + (std::log10(value) - low_) / (high_ - low_) * (to_ - from_);
  }
  // Decades; if there are few, 2 and 5 times each decade as well.
  std::vector<double> ticks() const {
    const bool fine = high_ - low_ < 3.2;
    std::vector<double> out;
    for (double decade = std::floor(low_); decade <= high_; ++decade) {
      for (const double part : {1.0, 2.0, 5.0}) {
        const double at = decade + std::log10(part);
        if ((part == 1.0 || fine) && at >= low_ && at <= high_) out.push_back(std::pow(10, at));
      }
    }
    return out;
  }

 private:
  double low_ = 1e300, high_ = -1e300, from_ = 0, to_ = 1;
};

struct Box {
  double x0, y0, x1, y1;
  bool meets(const Box& b) const { return x0 < b.x1 && b.x0 < x1 && y0 < b.y1 && b.y0 < y1; }
};

// Places labels where they overlap nothing, the nearest places first.
class Labels {
 public:
  void occupy(const Box& box) { taken_.push_back(box); }
  std::string place(double x, double y, const std::string& text, const char* color) {
    if (text.empty()) return {};
    const double w = kCharacter * static_cast<double>(text.size());
    const double offsets[][2] = {{7, 4},    {-7 - w, 4}, {-w / 2, -8},   {-w / 2, 17},
                                 {7, -8},   {7, 16},     {-7 - w, -8},   {-7 - w, 16},
                                 {12, -20}, {12, 28},    {-12 - w, -20}, {-12 - w, 28}};
    for (const auto& offset : offsets) {
      const Box box{x + offset[0], y + offset[1] - 9, x + offset[0] + w, y + offset[1] + 2};
      if (box.x0 < kLeft || box.x1 > kRight || box.y0 < kTop || box.y1 > kBottom) continue;
      if (std::any_of(taken_.begin(), taken_.end(), [&](const Box& b) { return b.meets(box); })) {
        continue;
      }
      taken_.push_back(box);
      return format(
                 "<text x=\"%.1f\" y=\"%.1f\" fill=\"%s\" stroke=\"#ffffff\" stroke-width=\"3\" "
                 "paint-order=\"stroke\">",
                 box.x0, y + offset[1], color) +
             escaped(text) + "</text>\n";
    }
    return {};  // the label is dropped; the table says which point it is
  }

 private:
  std::vector<Box> taken_;
};

std::string grid(const Plot& plot, const Axis& x, const Axis& y) {
  std::string out = "<g stroke=\"#dddddd\">\n";
  for (const double tick : x.ticks()) {
    out += format("<line x1=\"%.1f\" y1=\"%g\" x2=\"%.1f\" y2=\"%g\"/>\n", x.place(tick), kTop,
                  x.place(tick), kBottom);
  }
  for (const double tick : y.ticks()) {
    out += format("<line x1=\"%g\" y1=\"%.1f\" x2=\"%g\" y2=\"%.1f\"/>\n", kLeft, y.place(tick),
                  kRight, y.place(tick));
  }
  out += format(
      "</g>\n<rect x=\"%g\" y=\"%g\" width=\"%g\" height=\"%g\" fill=\"none\" "
      "stroke=\"#444444\"/>\n",
      kLeft, kTop, kRight - kLeft, kBottom - kTop);
  for (const double tick : x.ticks()) {
    out += format("<text x=\"%.1f\" y=\"%g\" text-anchor=\"middle\">%g</text>\n", x.place(tick),
                  kBottom + 17, tick);
  }
  for (const double tick : y.ticks()) {
    out += format("<text x=\"%g\" y=\"%.1f\" text-anchor=\"end\">%g</text>\n", kLeft - 6,
                  y.place(tick) + 4, tick);
  }
  out += format("<text x=\"%g\" y=\"%g\" text-anchor=\"middle\" font-size=\"13\">",
                (kLeft + kRight) / 2, kBottom + 42) +
         escaped(plot.x_label) + "</text>\n";
  out += format(
             "<text transform=\"translate(22 %g) rotate(-90)\" text-anchor=\"middle\" "
             "font-size=\"13\">",
             (kTop + kBottom) / 2) +
         escaped(plot.y_label) + "</text>\n";
  return out;
}

// Shortens a text to what fits in a line of the legend.
std::string shortened(const std::string& text) {
  constexpr std::size_t kMost = 34;
  return text.size() <= kMost ? text : text.substr(0, kMost - 3) + "...";
}

std::string draw_series(const PlotSeries& series, const char* color, const Axis& x, const Axis& y) {
  std::string path, marks;
  for (const PlotPoint& point : series.points) {
    if (!has_place(point.x, point.y)) continue;
    const double px = x.place(point.x), py = y.place(point.y);
    path += format("%s%.1f %.1f", path.empty() ? "M" : " L", px, py);
    const std::string key = point.key.empty() ? "" : " data-key=\"" + escaped(point.key) + "\"";
    marks += series.line ? format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.5\"", px, py)
                         : format("<path d=\"M%.1f %.1f l5 5 l-5 5 l-5 -5 z\"", px, py - 5);
    marks += key + "/>\n";
  }
  std::string out;
  if (series.line && !path.empty()) {
    out += format("<path fill=\"none\" stroke=\"%s\" stroke-width=\"1.5\" d=\"", color) + path +
           "\"/>\n";
  }
  return out + format("<g fill=\"%s\">\n", color) + marks + "</g>\n";
}

}  // namespace

std::string plot_svg(const Plot& plot) {
  Axis x, y;
  std::size_t left_out = 0;
  for (const PlotSeries& series : plot.series) {
    for (const PlotPoint& point : series.points) {
      if (!has_place(point.x, point.y)) {
        ++left_out;
        continue;
      }
      x.include(point.x);
      y.include(point.y);
    }
  }
  for (const PlotLevel& level : plot.levels) {
    if (has_place(1, level.y)) y.include(level.y);
  }
  x.finish(kLeft, kRight);
  y.finish(kBottom, kTop);

  std::string out = format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "viewBox=\"0 0 %g %g\" width=\"%g\" height=\"%g\" font-family=\"sans-serif\" "
      "font-size=\"11\" "
      "fill=\"#222222\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"#ffffff\"/>\n",
      kWidth, kHeight, kWidth, kHeight);
  out += format("<text x=\"%g\" y=\"26\" font-size=\"17\">", kLeft) + escaped(plot.title) +
         "</text>\n";
  out += format("<text x=\"%g\" y=\"46\" fill=\"#555555\" font-size=\"12\">", kLeft) +
         escaped(plot.subtitle) + "</text>\n";
  out += grid(plot, x, y);

  Labels labels;
  double legend = kTop + 10;
  for (const PlotLevel& level : plot.levels) {
    if (!has_place(1, level.y)) continue;
    const double at = y.place(level.y);
    out += format(
        "<line x1=\"%g\" y1=\"%.1f\" x2=\"%g\" y2=\"%.1f\" stroke=\"#888888\" stroke-dasharray=\"6 "
        "4\"/>\n",
        kLeft, at, kRight, at);
    out += format("<text x=\"%g\" y=\"%.1f\" fill=\"#666666\">", kLeft + 6, at - 4) +
           escaped(level.name) + "</text>\n";
    labels.occupy(
        {kLeft, at - 15, kLeft + 6 + kCharacter * static_cast<double>(level.name.size()), at});
  }
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const char* color = kColors[i % kColors.size()];
    out += draw_series(plot.series[i], color, x, y);
    out += format("<rect x=\"%g\" y=\"%.1f\" width=\"10\" height=\"10\" fill=\"%s\"/>\n",
                  kRight + 14, legend - 9, color);
    out += format("<text x=\"%g\" y=\"%.1f\">", kRight + 30, legend) +
           escaped(shortened(plot.series[i].name)) + "</text>\n";
    legend += 19;
    for (const PlotPoint& point : plot.series[i].points) {
      if (!has_place(point.x, point.y)) continue;
      const double px = x.place(point.x), py = y.place(point.y);
      labels.occupy({px - 4, py - 4, px + 4, py + 4});
    }
  }
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    for (const PlotPoint& point : plot.series[i].points) {
      if (!has_place(point.x, point.y)) continue;
      out += labels.place(x.place(point.x), y.place(point.y), point.label,
                          kColors[i % kColors.size()]);
    }
  }
  if (left_out > 0) {
    out += format(
        "<text x=\"%g\" y=\"%g\" fill=\"#666666\">%zu points without error or time have no place "
        "on these axes</text>\n",
        kLeft, kHeight - 8, left_out);
  }
  return out + "</svg>\n";
}

}  // namespace kaamos::effects
