// Rows of a window with robust weights, about the planes that they lie on.
#pragma once

#include <cstddef>
#include <vector>

#include <tilth/calibration/surface_rows.hpp>

namespace tilth {

/// Rows by cell, with their variances and weights.
struct WeightedRows {
  std::vector<SurfaceRow> rows;
  std::vector<std::size_t> begin;              ///< of each cell, and the end
  Eigen::VectorXd variance, weight, residual;  ///< [m^2], [1/m^2], [m] from the plane
};

/// What a plane's offset and tilts do to the distance of a row: (1, along, across).
Eigen::Vector3d place_in_cell(const SurfaceRow& row);

/// Information of a cell's plane: its offset [1/m^2], and its tilts over a cell.
Eigen::Matrix3d plane_information(const WeightedRows& w, std::size_t cell);

/// Fills in the residuals from each cell's own plane; returns each cell's mean squared one, in units of its variance.
std::vector<double> fit_planes(WeightedRows& w);

WeightedRows weighted_rows(SurfaceRows rows, const BeamCalibrationOptions& options);

}  // namespace tilth
