// SPDX-License-Identifier: MIT
// Plots with logarithmic axes, as self-contained SVG.
#pragma once

#include <string>
#include <vector>

namespace kaamos::effects {

struct PlotPoint {
  double x = 0;
  double y = 0;
  std::string label;  ///< beside the point; may be empty
};

struct PlotSeries {
  std::string name;  ///< in the legend
  std::vector<PlotPoint> points;
  bool line = true;  ///< false: points only, for settings that are no steps of one scale
};

/// A level that is drawn across, such as the error of the reference.
struct PlotLevel {
  std::string name;
  double y = 0;
};

struct Plot {
  std::string title;
  std::string subtitle;
  std::string x_label;  ///< with its unit
  std::string y_label;
  std::vector<PlotSeries> series;
  std::vector<PlotLevel> levels;
};

/// An SVG document, 900 x 600. Both axes are logarithmic: points that are not greater than 0 and
/// finite have no place and are left out, which the document says.
std::string plot_svg(const Plot& plot);

}  // namespace kaamos::effects
