#include <algorithm>
#include <cmath>
#include <cstring>

#include <tilth/atlas/place_table.hpp>
#include <tilth/core/error.hpp>

namespace tilth {
namespace {

constexpr std::size_t kTriangle = 21;
constexpr double kFarthest = 1e7;  // [m] of a place from the origin
constexpr std::int32_t kFarthestCell = 1 << 24;

/// As it lies in the file.
struct StoredPlace {
  double stamp;
  std::array<double, 7> pose;  // x y z [m], qx qy qz qw
  std::array<double, kTriangle> covariance;
  std::uint64_t begin;
  std::uint32_t size, checksum, patches, reserved;
};
static_assert(sizeof(StoredPlace) == 256);

constexpr std::size_t kCellBytes = 2 * sizeof(std::int32_t) + 1;

StoredPlace stored(const PlaceRecord& record) {
  StoredPlace s{};
  s.stamp = record.place.stamp;
  const Eigen::Vector3d t = record.place.T_map_lidar.translation();
  const Eigen::Quaterniond q = Eigen::Quaterniond(record.place.T_map_lidar.linear()).normalized();
  s.pose = {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
  std::size_t k = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) s.covariance[k++] = record.place.covariance(i, j);
  s.begin = record.begin, s.size = record.size, s.checksum = record.checksum;
  s.patches = record.place.patches;
  return s;
}

bool all_finite(const StoredPlace& s) {
  bool finite = std::isfinite(s.stamp);
  for (const double value : s.pose) finite &= std::isfinite(value);
  for (const double value : s.covariance) finite &= std::isfinite(value);
  return finite;
}

PlaceRecord record_of(const StoredPlace& s, std::uint64_t patch_bytes, const std::string& where) {
  if (!all_finite(s)) throw Error(where, "has a number that is not finite");
  const Eigen::Vector3d t(s.pose[0], s.pose[1], s.pose[2]);
  const Eigen::Quaterniond q(s.pose[6], s.pose[3], s.pose[4], s.pose[5]);
  if (!(std::abs(q.norm() - 1) < 1e-6)) throw Error(where, "has a quaternion that is not of length 1");
  if (!(t.cwiseAbs().maxCoeff() < kFarthest)) throw Error(where, "lies farther than 10000 km from the origin");
  if (s.begin > patch_bytes || s.size > patch_bytes - s.begin) {
    throw Error(where, "has patches at byte " + std::to_string(s.begin) + " to " + std::to_string(s.begin + s.size) +
                           ", expected less than the " + std::to_string(patch_bytes) + " of patches.bin");
  }
  PlaceRecord record{{s.stamp, Pose(Eigen::Translation3d(t) * q), {}, s.patches}, s.begin, s.size, s.checksum};
  std::size_t k = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) record.place.covariance(i, j) = record.place.covariance(j, i) = s.covariance[k++];
  return record;
}

void require_whole(std::size_t bytes, std::size_t record, const std::string& file) {
  if (bytes % record == 0) return;
  throw Error(file, "has " + std::to_string(bytes) + " bytes, expected a multiple of " + std::to_string(record));
}

}  // namespace

std::vector<std::byte> bytes_of(const std::vector<PlaceRecord>& records) {
  std::vector<std::byte> bytes(records.size() * sizeof(StoredPlace));
  for (std::size_t i = 0; i < records.size(); ++i) {
    const StoredPlace s = stored(records[i]);
    std::memcpy(bytes.data() + i * sizeof s, &s, sizeof s);
  }
  return bytes;
}

std::vector<PlaceRecord> records_of(std::span<const std::byte> bytes, std::uint64_t patch_bytes,
                                    const std::string& file) {
  require_whole(bytes.size(), sizeof(StoredPlace), file);
  std::vector<PlaceRecord> records;
  for (std::size_t i = 0; i < bytes.size() / sizeof(StoredPlace); ++i) {
    StoredPlace s;
    std::memcpy(&s, bytes.data() + i * sizeof s, sizeof s);
    records.push_back(record_of(s, patch_bytes, file + ", place " + std::to_string(i)));
  }
  return records;
}

std::vector<std::byte> bytes_of(const std::vector<UprightCell>& cells) {
  std::vector<std::byte> bytes(cells.size() * kCellBytes);
  std::byte* to = bytes.data();
  for (const UprightCell& cell : cells) {
    std::memcpy(to, &cell.x, sizeof cell.x);
    std::memcpy(to + sizeof cell.x, &cell.y, sizeof cell.y);
    to[2 * sizeof cell.x] = std::byte(cell.facings);
    to += kCellBytes;
  }
  return bytes;
}

std::vector<UprightCell> cells_of(std::span<const std::byte> bytes, const std::string& file) {
  require_whole(bytes.size(), kCellBytes, file);
  std::vector<UprightCell> cells(bytes.size() / kCellBytes);
  const std::byte* from = bytes.data();
  for (std::size_t i = 0; i < cells.size(); ++i, from += kCellBytes) {
    UprightCell& cell = cells[i];
    std::memcpy(&cell.x, from, sizeof cell.x);
    std::memcpy(&cell.y, from + sizeof cell.x, sizeof cell.y);
    cell.facings = std::to_integer<std::uint8_t>(from[2 * sizeof cell.x]);
    const std::string where = file + ", cell " + std::to_string(i);
    if (std::max(cell.x, cell.y) > kFarthestCell || std::min(cell.x, cell.y) < -kFarthestCell)
      throw Error(where, "lies farther than " + std::to_string(kFarthestCell) + " cells from the origin");
    if (i > 0 && std::pair(cell.y, cell.x) <= std::pair(cells[i - 1].y, cells[i - 1].x))
      throw Error(where, "does not come after the cell before it");
  }
  return cells;
}

}  // namespace tilth
