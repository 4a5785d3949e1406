// A grid of figures as an SVG picture: the smaller, the lighter; each cell says its figure.
#pragma once

#include <string>
#include <vector>

namespace tilth {

struct HeatMap {
  std::string title, x_name, y_name;
  std::vector<std::string> x_values, y_values;
  std::vector<std::vector<double>> cells;  ///< by y, then x; not finite: nothing is known
};

/// Self-contained; names are shown as they are, whatever they hold.
std::string heat_map_svg(const HeatMap& map);

}  // namespace tilth
