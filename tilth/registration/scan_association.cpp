#include <algorithm>
#include <limits>

#include <tilth/core/error.hpp>
#include <tilth/registration/accumulate.hpp>
#include <tilth/registration/line_plane_association.hpp>
#include <tilth/registration/scan_association.hpp>

namespace tilth {
namespace {

constexpr auto kNone = ScanTarget::kNone;
using Match = ScanTarget::Match;

struct Candidate {
  std::uint32_t index = kNone;
  double squared_distance = std::numeric_limits<double>::infinity();

  void offer(std::uint32_t i, double squared) {
    if (squared < squared_distance) *this = {i, squared};
  }
};

template <class Pair>
std::optional<Pair> pair_of(const Eigen::Vector3d& source, const ScanTarget& target, const Match& m, const Pose& T,
                            double weight_slope);

template <>
std::optional<PointToLine> pair_of(const Eigen::Vector3d& source, const ScanTarget& target, const Match& m,
                                   const Pose& T, double weight_slope) {
  if (m[0] == kNone || m[2] == kNone) return std::nullopt;
  const Eigen::Vector3d along = target[m[2]] - target[m[0]];
  if (!(along.norm() > 0)) return std::nullopt;
  return weighed(source, FittedLine{target[m[0]], along.normalized()}, T, weight_slope);
}

template <>
std::optional<PointToPlane> pair_of(const Eigen::Vector3d& source, const ScanTarget& target, const Match& m,
                                    const Pose& T, double weight_slope) {
  if (m[0] == kNone || m[1] == kNone || m[2] == kNone) return std::nullopt;
  const Eigen::Vector3d normal = (target[m[1]] - target[m[0]]).cross(target[m[2]] - target[m[0]]);
  if (!(normal.norm() > 0)) return std::nullopt;
  return weighed(source, FittedPlane{target[m[0]], normal.normalized()}, T, plane_slope(weight_slope, source.norm()));
}

}  // namespace

ScanTarget::ScanTarget(const PointCloud& cloud) : cloud_(cloud.points), rows_(cloud.rings) {
  if (rows_.size() != cloud_.size() || !std::is_sorted(rows_.begin(), rows_.end()))
    throw Error("scan target", "needs points with rings, in ascending order");
}

ScanTarget::Match ScanTarget::match_at(const Eigen::Vector3d& query, const ScanMatchOptions& options,
                                       std::size_t limit) const {
  const double max_squared = options.max_distance * options.max_distance;
  const std::optional<Neighbor> nearest = cloud_.nearest(query);
  if (!nearest || nearest->squared_distance >= max_squared) return {kNone, kNone, kNone};
  const int row = rows_[nearest->index];
  const auto row_less = [](int a, int b) { return a < b; };
  const auto begin = std::lower_bound(rows_.begin(), rows_.end(), row - options.row_reach, row_less);
  const auto end = std::upper_bound(rows_.begin(), rows_.end(), row + options.row_reach, row_less);
  Candidate same_row{kNone, max_squared}, other_row{kNone, max_squared};
  for (auto i = std::uint32_t(begin - rows_.begin()); i < std::uint32_t(end - rows_.begin()); ++i) {
    if (i == nearest->index || (i > nearest->index && i >= limit)) continue;
    (rows_[i] == row ? same_row : other_row).offer(i, ((*this)[i] - query).squaredNorm());
  }
  return {nearest->index, same_row.index, other_row.index};
}

template <class Pair>
std::vector<DuringScan<Pair>> ScanPairs<Pair>::operator()(const Pose& T_start_end) {
  const PointCloud& cloud = *scan_.cloud;
  const std::size_t limit = options_.truncated_search ? cloud.size() : target_.size();
  const bool renew = iterations_ % options_.renew_every == 0;
  const double weight_slope = iterations_ < options_.renew_every ? 0.0 : options_.weight_slope;
  ++iterations_;
  const ScanMotion motion({.velocity = log(T_start_end) / scan_.period, .duration = scan_.period}, 0.0);
  const Pose T_end_start = T_start_end.inverse();
  std::vector<DuringScan<Pair>> pairs;
  pairs.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double time = cloud.has_times() ? double(cloud.times[i]) : scan_.period;
    const Eigen::Vector3d point_at_start = motion.move(cloud.points[i], time);
    if (renew) matches_[i] = target_.match_at(point_at_start, options_, limit);
    const auto pair = pair_of<Pair>(T_end_start * point_at_start, target_, matches_[i], T_start_end, weight_slope);
    if (pair) pairs.push_back({*pair, time / scan_.period});
  }
  return pairs;
}

template void accumulate(LinearSystem&, std::span<const DuringScan<PointToLine>>, const Pose&, const RobustKernel&);
template void accumulate(LinearSystem&, std::span<const DuringScan<PointToPlane>>, const Pose&, const RobustKernel&);
template class ScanPairs<PointToLine>;
template class ScanPairs<PointToPlane>;

}  // namespace tilth
