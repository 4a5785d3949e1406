// Edge and plane points of a scan held against the lines and planes through two and three points of the last one,
// while the sensor moves (Zhang and Singh 2014, section V-B; LeGO-LOAM, Shan and Englot 2018). O(points of a few rows)
// a look-up.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/core/point_cloud.hpp>
#include <tilth/core/scan_motion.hpp>
#include <tilth/registration/residual.hpp>
#include <tilth/search/searchable_cloud.hpp>

namespace tilth {

struct ScanMatchOptions {
  double max_distance = 5.0;
  int row_reach = 2;
  int renew_every = 5;
  double weight_slope = 1.8;
  bool truncated_search = false;
};

template <class V>
void visit(ScanMatchOptions& o, V&& v) {
  v("max_distance", o.max_distance, Bounds{1e-3, 100}, "[m] between a point and each of those it is matched with");
  v("row_reach", o.row_reach, Bounds{1, 100}, "[rows] between the nearest point and the others", kAdvanced);
  v("renew_every", o.renew_every, Bounds{1, 1000}, "[iterations] after which the nearest points are looked up anew",
    kAdvanced);
  v("weight_slope", o.weight_slope, Bounds{0, 100},
    "[1/m] by which a pair's say falls with its distance once they have been looked up anew", kAdvanced);
  v("truncated_search", o.truncated_search,
    "[-] as LOAM and LeGO-LOAM: higher points are looked for only among as many as the new scan has of its own",
    kAdvanced);
}

/// The points of the last scan, row by row upwards, as the next one is matched with them.
class ScanTarget {
 public:
  /// `cloud` must have rings, ascending, unless it is empty.
  explicit ScanTarget(const PointCloud& cloud);

  using Match = std::array<std::uint32_t, 3>;  ///< the nearest point, the nearest of its row, the nearest of another
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  /// The points nearest to `query` [m], kNone where there is none within reach. Of those after the nearest one, which
  /// are on its row or above, only points numbered less than `limit` are looked at.
  Match match_at(const Eigen::Vector3d& query, const ScanMatchOptions& options, std::size_t limit) const;

  const Eigen::Vector3d& operator[](std::uint32_t i) const { return cloud_.points()[i]; }
  std::size_t size() const { return cloud_.size(); }

 private:
  SearchableCloud cloud_;
  std::vector<std::uint16_t> rows_;
};

/// The new scan's points with their times [s], of which it lasts `period`.
struct TimedScan {
  const PointCloud* cloud;
  double period;
};

/// A pair of a point that was measured when a `share` of the scan was over: that share of the motion moves it. Its
/// `source` is where the sensor at the end of the scan would have seen it.
template <class Pair>
struct DuringScan {
  Pair pair;
  double ratio;
  Eigen::Vector3d source = pair.source;

  auto residual(const Pose& T) const { return pair.residual(T); }
  auto derivative() const { return (ratio * pair.derivative()).eval(); }
};

/// The pairs at T_start_end, the LiDAR at the end of the scan seen from its start: `operator()` once an iteration.
template <class Pair>
class ScanPairs {
 public:
  ScanPairs(const TimedScan& scan, const ScanTarget& target, const ScanMatchOptions& options)
      : scan_(scan), target_(target), options_(options), matches_(scan.cloud->size()) {}

  std::vector<DuringScan<Pair>> operator()(const Pose& T_start_end);

 private:
  TimedScan scan_;
  const ScanTarget& target_;
  const ScanMatchOptions& options_;
  std::vector<ScanTarget::Match> matches_;
  int iterations_ = 0;
};

extern template void accumulate(LinearSystem&, std::span<const DuringScan<PointToLine>>, const Pose&,
                                const RobustKernel&);
extern template void accumulate(LinearSystem&, std::span<const DuringScan<PointToPlane>>, const Pose&,
                                const RobustKernel&);
extern template class ScanPairs<PointToLine>;   // through the nearest points of two rows
extern template class ScanPairs<PointToPlane>;  // through these and the second of the first row

}  // namespace tilth
