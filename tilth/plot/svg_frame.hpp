// Where a plot's parts stand in its drawing: the frame that the curves fill, and the scales of both axes.
#pragma once

#include <vector>

#include <tilth/plot/plot.hpp>
#include <tilth/plot/plot_scale.hpp>
#include <tilth/plot/svg_canvas.hpp>

namespace tilth {

struct SvgFrame {
  double width = 0.0, height = 0.0;  ///< [px] of the drawing
  double left = 0.0, right = 0.0;    ///< [px] of the frame's edges
  double top = 0.0, bottom = 0.0;
  Scale x, y;

  SvgPoint at(double vx, double vy) const { return {x(vx), y(vy)}; }
};

/// [px] of the frame's left edge: beside it the longest value of the y axis, and the axis' name, have room.
double left_of(const Plot& plot);

/// Between two values that the y axis names.
double y_tick_step(const Plot& plot, const Range& range);

/// The frame of `plot`, `head` [px] below the drawing's upper edge.
SvgFrame frame_of(const Plot& plot, double head);

/// Draws the curves, marks and bands of `plot` into `frame`.
void draw_content(SvgCanvas& canvas, const SvgFrame& frame, const Plot& plot);

/// Draws the cells of a heat plot, each with its value.
void draw_heat(SvgCanvas& canvas, const SvgFrame& frame, const Plot& plot);

/// The class of the n-th curve: one of eight colours, or that of the truth.
std::string curve_style(const Plot& plot, std::size_t n);

/// The colour of `share`, 0 to 1, of a path that is coloured by a value.
std::string shade_color(double ratio);

}  // namespace tilth
