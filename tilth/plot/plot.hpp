// A plot as a value: curves that say what they show, whoever draws them. It becomes an SVG file for papers
// (svg_plot.hpp) and a curve of report.html that answers the mouse (report/html_report.hpp).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tilth {

/// What is counted along an axis; the unit is empty for numbers of things.
struct Axis {
  std::string label, unit;
};

/// Lines: y over x. Path: a way in the plane, both axes to one scale. Boxes: one box for the values y of each curve.
/// Bars: for each curve one bar y[i] over categories[i]. Histogram: y[i] things between x[i] and x[i + 1]. Heat: a row
/// of cells for each curve, y[i] colours the one over categories[i]; a cell that is not finite is unknown.
enum class PlotKind { lines, path, boxes, bars, histogram, heat };

struct Curve {
  std::string name;
  std::vector<float> x, y;   ///< x is empty for boxes and bars
  std::vector<float> shade;  ///< of a path: the value that colours it at each point; else empty
  bool truth = false;        ///< drawn as what the others are held against, below them
  bool behind = false;       ///< drawn below the others, above the truth
};

/// A horizontal line across a plot.
struct Mark {
  std::string name;
  double value = 0.0;
};

/// A horizontal strip of a plot.
struct Band {
  std::string name;
  double low = 0.0, high = 0.0;
};

/// Vertical strips of a plot: stretches of x in which its curves are not to be believed.
struct Alarm {
  std::string name;
  std::vector<std::pair<double, double>> spans;  ///< from, to
};

struct Plot {
  std::string id;           ///< of lower case letters, digits and '_': the name of its file
  std::string title, note;  ///< the note says how to read it; may be empty
  PlotKind kind = PlotKind::lines;
  Axis x, y, shade;
  bool over_time = false;               ///< x is the time since the first pose: the slider of the map moves along it
  std::vector<std::string> categories;  ///< of bars and heat
  std::vector<Curve> curves;
  std::optional<Curve> links;  ///< of a path: lines over it, from an even point to the odd one after it
  std::optional<Curve> dots;   ///< of a path: points over it
  std::vector<Mark> marks;
  std::optional<Band> band;
  std::optional<Alarm> alarm;
};

}  // namespace tilth
