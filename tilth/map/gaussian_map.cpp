#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

#include <tilth/map/gaussian_map.hpp>

namespace tilth {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::int64_t kReach = 1 << 20;  // voxels from the origin that a key of 3 x 21 bits can name

std::int64_t key_of(std::int64_t x, std::int64_t y, std::int64_t z) {
  return ((x + kReach) << 42) | ((y + kReach) << 21) | (z + kReach);
}

std::size_t hash_of(std::int64_t key) {
  std::uint64_t h = std::uint64_t(key) * 0x9E3779B97F4A7C15ull;  // Fibonacci hashing
  return std::size_t(h ^ (h >> 32));
}

void add(GaussianVoxel& voxel, const Eigen::Vector3d& point) {
  ++voxel.count;
  const Eigen::Vector3d before = point - voxel.mean;
  voxel.mean += before / double(voxel.count);
  voxel.scatter.noalias() += before * (point - voxel.mean).transpose();  // Welford
}

// Surfaces are known along their normal only: this variance stands for "anywhere in the voxel" along them [m^2].
constexpr double kAlongSurface = 1.0;

// A line flatter than this (cosine to the LiDAR's axis) is what a single beam draws on any surface: it travels with the
// sensor and says nothing; a steeper one is a pole or a corner.
constexpr double kUpright = 0.5;
constexpr double kUnknown = 1e4;  // [m^2]

Eigen::Matrix3d regularized(const Eigen::Matrix3d& covariance, const GaussianMapOptions& options) {
  if (options.regularization == Regularization::none) return covariance;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(covariance);
  const Eigen::Vector3d& variance = eigen.eigenvalues();  // ascending
  const bool thin = variance[0] < options.surface_thickness * variance[1];
  const bool wide = variance[1] > options.surface_width * variance[2];
  const bool drawn_by_one_beam = !wide && std::abs(eigen.eigenvectors()(2, 2)) < kUpright;
  if (drawn_by_one_beam) return covariance + kUnknown * Eigen::Matrix3d::Identity();
  if (!thin || !wide) return covariance + options.blur * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d normal = eigen.eigenvectors().col(0);
  const double along_normal = std::max(variance[0], options.surface_variance) - kAlongSurface;
  return kAlongSurface * Eigen::Matrix3d::Identity() + along_normal * normal * normal.transpose();
}

}  // namespace

GaussianMap::GaussianMap(const GaussianMapOptions& options)
    : options_(options), inverse_size_(1.0 / options.voxel_size) {
  rebuild(1024);
}

void GaussianMap::rebuild(std::size_t slots) {
  slots_.assign(slots, Slot{0, kNone});
  for (std::uint32_t i = 0; i < keys_.size(); ++i) {
    slots_[slot_of(keys_[i])] = {keys_[i], i};
  }
}

std::size_t GaussianMap::slot_of(std::int64_t key) const {
  std::size_t s = hash_of(key) & (slots_.size() - 1);
  while (slots_[s].voxel != kNone && slots_[s].key != key) s = (s + 1) & (slots_.size() - 1);
  return s;
}

void GaussianMap::insert(std::span<const Eigen::Vector3d> points_in_map) {
  const double reach = double(kReach - 2) * options_.voxel_size;
  for (const Eigen::Vector3d& p : points_in_map) {
    if (!(p.cwiseAbs().maxCoeff() < reach)) continue;
    if (2 * (voxels_.size() + 1) > slots_.size()) rebuild(2 * slots_.size());
    const Eigen::Array3d cell = (p.array() * inverse_size_).floor();
    const std::int64_t key = key_of(std::int64_t(cell.x()), std::int64_t(cell.y()), std::int64_t(cell.z()));
    Slot& slot = slots_[slot_of(key)];
    if (slot.voxel == kNone) {
      slot = {key, std::uint32_t(voxels_.size())};
      voxels_.emplace_back();
      keys_.push_back(key);
    }
    GaussianVoxel& voxel = voxels_[slot.voxel];
    if (voxel.count >= std::uint32_t(options_.max_points)) continue;
    add(voxel, p);
    refresh(voxel);
  }
}

void GaussianMap::refresh(GaussianVoxel& voxel) const {
  const bool due = voxel.count >= std::uint32_t(options_.min_points) && 10 * voxel.count >= 11 * voxel.covariance_count;
  if (!due) return;
  voxel.covariance = regularized(voxel.scatter / double(voxel.count - 1), options_);
  voxel.covariance_count = voxel.count;
}

void GaussianMap::crop(const Eigen::Vector3d& center) {
  if ((center - last_center_).norm() < 0.1 * options_.max_range) return;
  last_center_ = center;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < voxels_.size(); ++i) {
    if ((voxels_[i].mean - center).norm() > options_.max_range) continue;
    voxels_[kept] = voxels_[i];
    keys_[kept++] = keys_[i];
  }
  voxels_.resize(kept);
  keys_.resize(kept);
  std::size_t slots = 1024;
  while (slots < 4 * kept) slots *= 2;
  rebuild(slots);
}

const GaussianVoxel* GaussianMap::at(std::int64_t x, std::int64_t y, std::int64_t z) const {
  const Slot& slot = slots_[slot_of(key_of(x, y, z))];
  if (slot.voxel == kNone) return nullptr;
  const GaussianVoxel& voxel = voxels_[slot.voxel];
  return voxel.count >= std::uint32_t(options_.min_points) ? &voxel : nullptr;
}

const GaussianVoxel* GaussianMap::find(const Eigen::Vector3d& point) const {
  const Eigen::Array3d cell = (point.array() * inverse_size_).floor();
  if (!(cell.abs().maxCoeff() < double(kReach - 2))) return nullptr;
  return at(std::int64_t(cell.x()), std::int64_t(cell.y()), std::int64_t(cell.z()));
}

const GaussianVoxel* GaussianMap::find_nearest(const Eigen::Vector3d& point) const {
  const Eigen::Array3d corner = (point.array() * inverse_size_ - 0.5).floor();
  if (!(corner.abs().maxCoeff() < double(kReach - 2))) return nullptr;
  const GaussianVoxel* nearest = nullptr;
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 8; ++i) {
    const GaussianVoxel* voxel = at(std::int64_t(corner.x()) + (i & 1), std::int64_t(corner.y()) + (i >> 1 & 1),
                                    std::int64_t(corner.z()) + (i >> 2));
    if (voxel == nullptr) continue;
    const double d = (voxel->mean - point).squaredNorm();
    if (d < best) best = d, nearest = voxel;
  }
  return nearest;
}

}  // namespace tilth
