#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include <tilth/calibration/surface_weights.hpp>
#include <tilth/core/median.hpp>

namespace tilth {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kReweighted = 3;                       // times
constexpr double kPlaneHold = 1e-5, kTiltHold = 10;  // [1/m^2] on a plane's place and its tilts over a cell
constexpr double kUsualCell = 1.5;                   // mean squared residual of a cell that is none too many

/// Geman-McClure on rows, and on whole cells: steps and corners are no planes.
void reweight(WeightedRows& w, const std::vector<double>& chi, double kernel) {
  const double usual = std::max(4 * median(chi), kUsualCell);
  for (std::size_t c = 0; c + 1 < w.begin.size(); ++c) {
    const double of_cell = std::pow(1 + std::pow(chi[c] / usual, 2), -2);
    for (std::size_t i = w.begin[c]; i < w.begin[c + 1]; ++i) {
      const auto k = Eigen::Index(i);
      const double excess = w.residual[k] * w.residual[k] / (w.variance[k] * kernel * kernel);
      w.weight[k] = of_cell / w.variance[k] / std::pow(1 + excess, 2);
    }
  }
}

}  // namespace

Vector3d place_in_cell(const SurfaceRow& row) {
  return {1, row.along, row.across};
}

Matrix3d plane_information(const WeightedRows& w, std::size_t cell) {
  Matrix3d L = Vector3d(kPlaneHold, kTiltHold, kTiltHold).asDiagonal();
  for (std::size_t i = w.begin[cell]; i < w.begin[cell + 1]; ++i) {
    const Vector3d b = place_in_cell(w.rows[i]);
    L += w.weight[Eigen::Index(i)] * b * b.transpose();
  }
  return L;
}

std::vector<double> fit_planes(WeightedRows& w) {
  std::vector<double> chi(w.begin.size() - 1);
  for (std::size_t c = 0; c + 1 < w.begin.size(); ++c) {
    Vector3d right = Vector3d::Zero();
    for (std::size_t i = w.begin[c]; i < w.begin[c + 1]; ++i)
      right += w.weight[Eigen::Index(i)] * w.rows[i].distance * place_in_cell(w.rows[i]);
    const Vector3d plane = plane_information(w, c).ldlt().solve(right);
    for (std::size_t i = w.begin[c]; i < w.begin[c + 1]; ++i) {
      const auto k = Eigen::Index(i);
      w.residual[k] = w.rows[i].distance - place_in_cell(w.rows[i]).dot(plane);
      chi[c] += w.residual[k] * w.residual[k] / w.variance[k] / double(w.begin[c + 1] - w.begin[c]);
    }
  }
  return chi;
}

WeightedRows weighted_rows(SurfaceRows rows, const BeamCalibrationOptions& o) {
  WeightedRows w;
  w.rows = std::move(rows.rows);
  const auto n = Eigen::Index(w.rows.size());
  w.variance.resize(n), w.weight.resize(n), w.residual.resize(n);
  for (std::size_t i = 0; i < w.rows.size(); ++i) {
    const SurfaceRow& row = w.rows[i];
    if (i == 0 || row.cell != w.rows[i - 1].cell) w.begin.push_back(i);
    w.variance[Eigen::Index(i)] = std::pow(o.noise * row.by_range, 2) / row.count + o.floor * o.floor;
  }
  w.begin.push_back(w.rows.size());
  if (w.rows.empty()) return w;
  w.weight = w.variance.cwiseInverse();
  for (int i = 0; i < kReweighted; ++i) reweight(w, fit_planes(w), o.kernel);
  fit_planes(w);
  return w;
}

}  // namespace tilth
