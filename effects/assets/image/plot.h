// SPDX-License-Identifier: MIT
/// @file
/// Plots with logarithmic axes, as self-contained SVG.
#pragma once

#include <string>
#include <vector>

namespace kaamos::effects {

/// A measurement.
struct PlotPoint {
  /// On the axes; drawn if both are greater than 0 and finite.
  ///@{
  double x = 0;
  double y = 0;
  ///@}
  std::string label;  ///< beside the point; may be empty
  std::string key;    ///< its mark's attribute data-key, for scripts; may be empty
};

/// Points of one colour.
struct PlotSeries {
  std::string name;               ///< in the legend
  std::vector<PlotPoint> points;  ///< in the order in which the line joins them
  bool line = true;  ///< false: points only, for settings that are no steps of one scale
};

/// A level that is drawn across, such as the error of the reference.
struct PlotLevel {
  std::string name;  ///< beside the line
  double y = 0;      ///< greater than 0
};

/// A diagram.
struct Plot {
  std::string title;               ///< in the first line
  std::string subtitle;            ///< below it, smaller
  std::string x_label;             ///< with its unit
  std::string y_label;             ///< with its unit
  std::vector<PlotSeries> series;  ///< in the order of the legend
  std::vector<PlotLevel> levels;   ///< drawn below the series
};

/// An SVG document, 900 x 600. Both axes are logarithmic: points that are not greater than 0 and
/// finite have no place and are left out, which the document says.
std::string plot_svg(const Plot& plot);

}  // namespace kaamos::effects
