#include <algorithm>
#include <cmath>
#include <limits>

#include <tilth/freespace/ground_height.hpp>

namespace tilth {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr float kLevel = 0.1F;         // [m] within which points are one level
constexpr std::size_t kFewest = 4;     // points of a level
constexpr float kStep = 0.15F;         // [m] that the ground may step up or down between patches
constexpr float kSlope = 0.25F;        // [-] of ground that is not seen
constexpr float kSensorAbove = 0.15F;  // [m] the least that a sensor is above the ground

/// The lowest level of at least kFewest heights, or none.
float lowest_level(std::vector<float>& heights) {
  std::sort(heights.begin(), heights.end());
  for (std::size_t i = 0; i + kFewest <= heights.size(); ++i) {
    if (heights[i + kFewest - 1] - heights[i] > kLevel) continue;
    std::size_t end = i;
    while (end < heights.size() && heights[end] - heights[i] <= kLevel) ++end;
    return heights[(i + end) / 2];
  }
  return kNone;
}

}  // namespace

GroundHeight::GroundHeight(std::span<const Eigen::Vector3f> points, std::span<const Eigen::Vector3f> way,
                           const Eigen::Vector2f& low, const Eigen::Vector2f& high)
    : low_(low),
      columns_(int(std::ceil((high.x() - low.x()) / kPatch)) + 1),
      rows_(int(std::ceil((high.y() - low.y()) / kPatch)) + 1),
      heights_(std::size_t(columns_) * std::size_t(rows_), kNone) {
  const std::vector<float> levels = floors(points);
  std::vector<int> seeds;
  std::vector<float> drops;
  for (const Eigen::Vector3f& p : way) {
    const std::size_t patch = number(column_of(p.x()), row_of(p.y()));
    if (levels[patch] < p.z() - kSensorAbove) drops.push_back(p.z() - levels[patch]);
  }
  std::nth_element(drops.begin(), drops.begin() + std::ptrdiff_t(drops.size() / 2), drops.end());
  const float drop = drops.empty() ? 0 : drops[drops.size() / 2];
  for (const Eigen::Vector3f& p : way) {
    const std::size_t patch = number(column_of(p.x()), row_of(p.y()));
    if (!std::isnan(heights_[patch])) continue;
    const bool floor = std::abs(p.z() - drop - levels[patch]) < 2 * kStep;
    heights_[patch] = floor ? levels[patch] : p.z() - drop;
    seeds.push_back(int(patch));
  }
  spread(levels, std::move(seeds));
}

int GroundHeight::column_of(float x) const {
  return std::clamp(int((x - low_.x()) / kPatch), 0, columns_ - 1);
}

int GroundHeight::row_of(float y) const {
  return std::clamp(int((y - low_.y()) / kPatch), 0, rows_ - 1);
}

std::vector<float> GroundHeight::floors(std::span<const Eigen::Vector3f> points) const {
  std::vector<std::vector<float>> heights(heights_.size());
  for (const Eigen::Vector3f& p : points) heights[number(column_of(p.x()), row_of(p.y()))].push_back(p.z());
  std::vector<float> levels(heights.size());
  std::transform(heights.begin(), heights.end(), levels.begin(), lowest_level);
  return levels;
}

/// Breadth first, from patches whose height is known.
void GroundHeight::spread(const std::vector<float>& floors, std::vector<int> from) {
  std::vector<std::uint16_t> unseen(heights_.size(), 0);  // patches since the last floor
  for (std::size_t next = 0; next < from.size(); ++next) {
    const int column = from[next] % columns_, row = from[next] / columns_;
    for (int side = 0; side < 4; ++side) {
      const int c = column + (side == 0) - (side == 1), r = row + (side == 2) - (side == 3);
      if (c < 0 || r < 0 || c >= columns_ || r >= rows_ || !std::isnan(heights_[number(c, r)])) continue;
      const float here = heights_[std::size_t(from[next])], floor = floors[number(c, r)];
      const std::uint16_t gap = unseen[std::size_t(from[next])];
      const bool seen = std::abs(floor - here) <= kStep + kSlope * kPatch * float(gap);
      heights_[number(c, r)] = seen ? floor : here;
      unseen[number(c, r)] = seen ? std::uint16_t(0) : std::uint16_t(std::min(gap + 1, 1000));
      from.push_back(int(number(c, r)));
    }
  }
}

float GroundHeight::at(float x, float y) const {
  const float u = std::clamp((x - low_.x()) / kPatch - 0.5F, 0.0F, float(columns_ - 1));
  const float v = std::clamp((y - low_.y()) / kPatch - 0.5F, 0.0F, float(rows_ - 1));
  const int c = std::min(int(u), std::max(0, columns_ - 2)), r = std::min(int(v), std::max(0, rows_ - 2));
  const int c1 = std::min(c + 1, columns_ - 1), r1 = std::min(r + 1, rows_ - 1);
  const float a = u - float(c), b = v - float(r);
  return (1 - b) * ((1 - a) * heights_[number(c, r)] + a * heights_[number(c1, r)]) +
         b * ((1 - a) * heights_[number(c, r1)] + a * heights_[number(c1, r1)]);
}

}  // namespace tilth
