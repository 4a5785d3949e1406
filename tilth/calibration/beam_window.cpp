#include <array>
#include <limits>
#include <numbers>

#include <Eigen/Cholesky>

#include <tilth/calibration/beam_window.hpp>
#include <tilth/calibration/surface_weights.hpp>
#include <tilth/core/median.hpp>

namespace tilth {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kHoldTurn = 3 * std::numbers::pi / 180;  // [rad] that a pose may be off
constexpr double kHoldShift = 0.3;                        // [m]
constexpr double kFirst = 1e10;                           // information that holds the first pose

/// Columns that a row depends on, and its derivatives by them: beams, then poses, then what it is off by.
constexpr int kEntries = 14;
struct Entries {
  std::array<Eigen::Index, kEntries> column;
  Eigen::Matrix<double, kEntries, 1> value;
};

Entries entries_of(const SurfaceRow& row, std::size_t rings, std::size_t keyframes) {
  const auto n = Eigen::Index(rings), parameters = 2 * n + 5;
  Entries e;
  e.column[0] = row.ring, e.value[0] = -row.by_range;
  e.column[1] = n + row.ring, e.value[1] = -row.by_elevation;
  e.column[2] = 2 * n, e.value[2] = -row.by_walk;
  for (int j = 0; j < 4; ++j) e.column[std::size_t(3 + j)] = 2 * n + 1 + j, e.value[3 + j] = -row.by_encoder[j];
  for (int j = 0; j < 6; ++j) {
    e.column[std::size_t(7 + j)] = parameters + 6 * row.keyframe + j, e.value[7 + j] = row.by_pose[j];
  }
  e.column[13] = parameters + 6 * Eigen::Index(keyframes), e.value[13] = row.distance;
  return e;
}

/// Normal equations of a cell over the columns it touches, its plane eliminated, added to the whole.
class Reducer {
 public:
  Reducer(Eigen::Index columns) : whole_(MatrixXd::Zero(columns, columns)), local_of_(std::size_t(columns), -1) {}

  void add_cell(const WeightedRows& w, std::size_t cell, std::size_t rings, std::size_t keyframes) {
    touched_.clear();
    entries_.clear();
    for (std::size_t i = w.begin[cell]; i < w.begin[cell + 1]; ++i) {
      entries_.push_back(entries_of(w.rows[i], rings, keyframes));
      for (const Eigen::Index column : entries_.back().column) touch(column);
    }
    const auto m = Eigen::Index(touched_.size());
    MatrixXd H = MatrixXd::Zero(m, m), C = MatrixXd::Zero(3, m);
    for (std::size_t i = w.begin[cell]; i < w.begin[cell + 1]; ++i) {
      const Entries& e = entries_[i - w.begin[cell]];
      const double weight = w.weight[Eigen::Index(i)];
      const Vector3d b = weight * place_in_cell(w.rows[i]);
      for (int p = 0; p < kEntries; ++p) {
        const Eigen::Index row = local_of_[std::size_t(e.column[std::size_t(p)])];
        C.col(row) += e.value[p] * b;
        for (int q = 0; q < kEntries; ++q)
          H(row, local_of_[std::size_t(e.column[std::size_t(q)])]) += weight * e.value[p] * e.value[q];
      }
    }
    H -= C.transpose() * plane_information(w, cell).ldlt().solve(C);
    for (Eigen::Index p = 0; p < m; ++p) {
      for (Eigen::Index q = 0; q < m; ++q) whole_(touched_[std::size_t(p)], touched_[std::size_t(q)]) += H(p, q);
    }
    for (const Eigen::Index column : touched_) local_of_[std::size_t(column)] = -1;
  }

  const MatrixXd& whole() const { return whole_; }

 private:
  void touch(Eigen::Index column) {
    if (local_of_[std::size_t(column)] >= 0) return;
    local_of_[std::size_t(column)] = Eigen::Index(touched_.size());
    touched_.push_back(column);
  }

  MatrixXd whole_;
  std::vector<Eigen::Index> local_of_, touched_;
  std::vector<Entries> entries_;
};

/// Poses eliminated by Schur's complement, with a loose hold.
BeamWindow without_poses(const MatrixXd& H, Eigen::Index parameters, std::size_t keyframes) {
  const auto poses = 6 * Eigen::Index(keyframes);
  VectorXd hold(poses);
  for (Eigen::Index k = 0; k < poses; k += 6) {
    hold.segment<3>(k).setConstant(k == 0 ? kFirst : 1 / (kHoldTurn * kHoldTurn));
    hold.segment<3>(k + 3).setConstant(k == 0 ? kFirst : 1 / (kHoldShift * kHoldShift));
  }
  MatrixXd Hpp = H.block(parameters, parameters, poses, poses);
  Hpp.diagonal() += hold;
  MatrixXd right(poses, parameters + 1);
  right << H.block(parameters, 0, poses, parameters), H.block(parameters, parameters + poses, poses, 1);
  BeamWindow window;
  window.poses_by_beams = Hpp.ldlt().solve(right);
  const auto Htp = H.block(0, parameters, parameters, poses);
  window.information = H.topLeftCorner(parameters, parameters) - Htp * window.poses_by_beams.leftCols(parameters);
  window.gradient = H.block(0, parameters + poses, parameters, 1) - Htp * window.poses_by_beams.rightCols(1);
  return window;
}

void add_residuals(BeamWindow& window, const WeightedRows& w, std::size_t rings) {
  window.residual = VectorXd::Zero(Eigen::Index(rings)), window.weight = VectorXd::Zero(Eigen::Index(rings));
  for (std::size_t i = 0; i < w.rows.size(); ++i) {
    const auto k = Eigen::Index(i);
    const SurfaceRow& row = w.rows[i];
    window.residual[row.ring] += w.weight[k] * row.by_range * w.residual[k];
    window.weight[row.ring] += w.weight[k] * row.by_range * row.by_range;
  }
}

}  // namespace

BeamWindow eliminate(const WeightedRows& w, std::size_t rings, std::size_t keyframes) {
  const auto parameters = 2 * Eigen::Index(rings) + 5;
  Reducer reducer(parameters + 6 * Eigen::Index(keyframes) + 1);
  for (std::size_t c = 0; c + 1 < w.begin.size(); ++c) reducer.add_cell(w, c, rings, keyframes);
  BeamWindow window = without_poses(reducer.whole(), parameters, keyframes);
  window.rows = w.rows.size();
  add_residuals(window, w, rings);
  return window;
}

BeamWindow beam_window(std::span<const BeamKeyframe> keyframes, const BeamModel& beams, std::size_t rings,
                       const BeamCalibrationOptions& options) {
  SurfaceRows rows = surface_rows(keyframes, beams, options);
  const double thickness = rows.thickness.empty() ? 0.0 : median(rows.thickness);
  BeamWindow window = eliminate(weighted_rows(std::move(rows), options), rings, keyframes.size());
  window.thickness = thickness;
  return window;
}

BeamFit fit_of(std::span<const BeamWindow> windows) {
  VectorXd residual = VectorXd::Zero(windows.front().residual.size()), weight = residual;
  std::vector<double> thickness;
  for (const BeamWindow& w : windows) {
    residual += w.residual, weight += w.weight;
    if (w.thickness > 0) thickness.push_back(w.thickness);
  }
  BeamFit fit;
  for (Eigen::Index k = 0; k < residual.size(); ++k) {
    fit.residual.push_back(weight[k] > 0 ? residual[k] / weight[k] : std::numeric_limits<double>::quiet_NaN());
  }
  if (!thickness.empty()) fit.thickness = median(thickness);
  return fit;
}

void follow(std::span<BeamKeyframe> keyframes, const BeamWindow& window, const VectorXd& step) {
  const Eigen::Index parameters = step.size();
  const VectorXd poses = -(window.poses_by_beams.leftCols(parameters) * step + window.poses_by_beams.rightCols(1));
  for (std::size_t k = 0; k < keyframes.size(); ++k) {
    const Vector6d d = poses.segment<6>(6 * Eigen::Index(k));
    Pose& T = keyframes[k].T_map_lidar;
    T.linear() = exp((Vector6d() << d.head<3>(), 0, 0, 0).finished()).linear() * T.linear();
    T.translation() += d.tail<3>();
  }
}

}  // namespace tilth
