// A Plot as SVG: axes with round numbers and units, legend, curves. O(points).
#pragma once

#include <string>

#include <tilth/plot/plot.hpp>

namespace tilth {

/// For a page whose sheet has the classes of svg_style().
std::string svg_inline(const Plot& plot);

/// A file of its own, with title and sheet, black on white.
std::string svg_file(const Plot& plot);

/// The text of the axis as it is written: "speed [m/s]".
std::string axis_text(const Axis& axis);

}  // namespace tilth
