#include <cmath>
#include <limits>

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

}  // namespace

GaussianMap::GaussianMap(const GaussianMapOptions& options) : options_(options), inverse_size_(1.0 / options.voxel_size) { rebuild(1024); }

void GaussianMap::rebuild(std::size_t slots) {
  slots_.assign(slots, Slot{0, kNone});
  for (std::uint32_t i = 0; i < keys_.size(); ++i) {
    std::size_t s = hash_of(keys_[i]) & (slots - 1);
    while (slots_[s].voxel != kNone) s = (s + 1) & (slots - 1);
    slots_[s] = {keys_[i], i};
  }
}

std::uint32_t& GaussianMap::slot_of(std::int64_t key) {
  std::size_t s = hash_of(key) & (slots_.size() - 1);
  while (slots_[s].voxel != kNone && slots_[s].key != key) s = (s + 1) & (slots_.size() - 1);
  slots_[s].key = key;
  return slots_[s].voxel;
}

void GaussianMap::insert(std::span<const Eigen::Vector3d> points_in_map) {
  const double reach = double(kReach - 2) * options_.voxel_size;
  for (const Eigen::Vector3d& p : points_in_map) {
    if (!(p.cwiseAbs().maxCoeff() < reach)) continue;
    if (2 * (voxels_.size() + 1) > slots_.size()) rebuild(2 * slots_.size());
    const Eigen::Array3d cell = (p.array() * inverse_size_).floor();
    const std::int64_t key = key_of(std::int64_t(cell.x()), std::int64_t(cell.y()), std::int64_t(cell.z()));
    std::uint32_t& index = slot_of(key);
    if (index == kNone) {
      index = std::uint32_t(voxels_.size());
      voxels_.emplace_back();
      keys_.push_back(key);
    }
    if (voxels_[index].count < std::uint32_t(options_.max_points)) add(voxels_[index], p);
  }
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
  const std::int64_t key = key_of(x, y, z);
  std::size_t s = hash_of(key) & (slots_.size() - 1);
  while (slots_[s].voxel != kNone && slots_[s].key != key) s = (s + 1) & (slots_.size() - 1);
  if (slots_[s].voxel == kNone) return nullptr;
  const GaussianVoxel& voxel = voxels_[slots_[s].voxel];
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
    const GaussianVoxel* voxel = at(std::int64_t(corner.x()) + (i & 1), std::int64_t(corner.y()) + (i >> 1 & 1), std::int64_t(corner.z()) + (i >> 2));
    if (voxel == nullptr) continue;
    const double d = (voxel->mean - point).squaredNorm();
    if (d < best) best = d, nearest = voxel;
  }
  return nearest;
}

}  // namespace tilth
