#include <algorithm>

#include "arrays.hpp"

namespace tilth::python {
namespace {

template <class Matrix>
double* row_major_copy(const Matrix& matrix) {
  auto* const data = new double[std::size_t(matrix.size())];
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index column = 0; column < matrix.cols(); ++column)
      data[row * matrix.cols() + column] = matrix(row, column);
  }
  return data;
}

nb::capsule owner_of(double* data) {
  return nb::capsule(data, [](void* p) noexcept { delete[] static_cast<double*>(p); });
}

template <class PoseAt>
PosesArray poses_by(std::size_t size, const PoseAt& pose_at) {
  auto* const data = new double[std::max<std::size_t>(1, 16 * size)];
  const nb::capsule owner = owner_of(data);
  for (std::size_t i = 0; i < size; ++i) {
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix = pose_at(i).matrix();
    std::copy(matrix.data(), matrix.data() + 16, data + 16 * i);
  }
  return PosesArray(data, {size, 4, 4}, owner);
}

}  // namespace

PoseArray array_of(const Pose& pose) {
  double* const data = row_major_copy(pose.matrix());
  return PoseArray(data, {4, 4}, owner_of(data));
}

Matrix6Array array_of(const Matrix6d& matrix) {
  double* const data = row_major_copy(matrix);
  return Matrix6Array(data, {6, 6}, owner_of(data));
}

Vector6Array array_of(const Vector6d& vector) {
  double* const data = row_major_copy(vector);
  return Vector6Array(data, {6}, owner_of(data));
}

PosesArray array_of(const std::vector<Pose>& poses) {
  return poses_by(poses.size(), [&](std::size_t i) { return poses[i]; });
}

PosesArray poses_array(const Trajectory& trajectory) {
  return poses_by(trajectory.size(), [&](std::size_t i) { return trajectory[i].T_world_lidar; });
}

ColumnArray<double> stamps_array(const Trajectory& trajectory) {
  std::vector<double> stamps;
  for (const StampedPose& pose : trajectory) stamps.push_back(pose.stamp);
  return column_array(std::move(stamps));
}

PointArray array_of(std::vector<Eigen::Vector3d> points) {
  using Points = std::vector<Eigen::Vector3d>;
  auto* const kept = new Points(std::move(points));
  const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<Points*>(p); });
  return PointArray(never_null(kept->empty() ? nullptr : kept->front().data()), {kept->size(), 3}, owner);
}

}  // namespace tilth::python
