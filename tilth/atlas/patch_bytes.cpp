#include <bit>
#include <cmath>
#include <cstring>
#include <zlib.h>

#include <tilth/atlas/patch_bytes.hpp>
#include <tilth/core/error.hpp>

namespace tilth {
namespace {

static_assert(std::endian::native == std::endian::little, "maps are written and read as they lie in memory");

constexpr std::size_t kFloats = 13, kShorts = 2;  // mean, covariance, normal and thickness; points and ring
constexpr std::size_t kPatchBytes = kFloats * sizeof(float) + kShorts * sizeof(std::uint16_t) + 1;
constexpr float kFarthest = 1e5F;  // [m] of a mean or a deviation

using Floats = std::array<float, kFloats>;

Floats floats_of(const SurfacePatch& p) {
  const Eigen::Matrix3d& c = p.covariance;
  const auto f = [](double value) { return float(value); };
  return {f(p.mean.x()), f(p.mean.y()), f(p.mean.z()),   f(c(0, 0)),      f(c(1, 1)),      f(c(2, 2)), f(c(0, 1)),
          f(c(1, 2)),    f(c(0, 2)),    f(p.normal.x()), f(p.normal.y()), f(p.normal.z()), p.thickness};
}

SurfacePatch patch_of(const Floats& v) {
  SurfacePatch patch;
  patch.mean = Eigen::Vector3d(v[0], v[1], v[2]);
  patch.covariance << v[3], v[6], v[8], v[6], v[4], v[7], v[8], v[7], v[5];
  patch.normal = Eigen::Vector3d(v[9], v[10], v[11]);
  patch.thickness = v[12];
  return patch;
}

bool possible(const SurfacePatch& p) {
  const double length = p.normal.norm();
  return p.mean.allFinite() && p.covariance.allFinite() && p.mean.cwiseAbs().maxCoeff() < kFarthest &&
         p.covariance.cwiseAbs().maxCoeff() < kFarthest && p.covariance.diagonal().minCoeff() >= 0 &&
         p.thickness >= 0 && p.thickness < kFarthest && length > 0.99 && length < 1.01 && p.points > 0;
}

/// Values of one field of all patches, one after another, each at its place among bytes.
template <class T>
void store(T value, std::size_t column, std::size_t row, std::size_t rows, std::byte* bytes) {
  std::memcpy(bytes + (column * rows + row) * sizeof(T), &value, sizeof(T));
}

template <class T>
T load(std::size_t column, std::size_t row, std::size_t rows, const std::byte* bytes) {
  T value;
  std::memcpy(&value, bytes + (column * rows + row) * sizeof(T), sizeof(T));
  return value;
}

}  // namespace

std::vector<std::byte> bytes_of(const SurfacePatches& patches) {
  const std::size_t n = patches.size();
  std::vector<std::byte> bytes(n * kPatchBytes);
  std::byte* const shorts = bytes.data() + n * kFloats * sizeof(float);
  std::byte* const flags = shorts + n * kShorts * sizeof(std::uint16_t);
  for (std::size_t i = 0; i < n; ++i) {
    const Floats values = floats_of(patches[i]);
    for (std::size_t k = 0; k < kFloats; ++k) store(values[k], k, i, n, bytes.data());
    store(patches[i].points, 0, i, n, shorts);
    store(patches[i].ring, 1, i, n, shorts);
    flags[i] = std::byte(patches[i].flat);
  }
  return bytes;
}

SurfacePatches patches_of(std::span<const std::byte> bytes, const std::string& where) {
  if (bytes.size() % kPatchBytes != 0) {
    throw Error(
        where, "has " + std::to_string(bytes.size()) + " bytes, expected a multiple of " + std::to_string(kPatchBytes));
  }
  const std::size_t n = bytes.size() / kPatchBytes;
  const std::byte* const shorts = bytes.data() + n * kFloats * sizeof(float);
  const std::byte* const flags = shorts + n * kShorts * sizeof(std::uint16_t);
  SurfacePatches patches;
  patches.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    Floats values;
    for (std::size_t k = 0; k < kFloats; ++k) values[k] = load<float>(k, i, n, bytes.data());
    SurfacePatch patch = patch_of(values);
    patch.points = load<std::uint16_t>(0, i, n, shorts);
    patch.ring = load<std::uint16_t>(1, i, n, shorts);
    patch.flat = std::to_integer<int>(flags[i]) != 0;
    if (!possible(patch)) throw Error(where, "patch " + std::to_string(i) + " has a value that none can have");
    patches.push_back(patch);
  }
  return patches;
}

std::uint32_t checksum(std::span<const std::byte> bytes) {
  return std::uint32_t(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace tilth
