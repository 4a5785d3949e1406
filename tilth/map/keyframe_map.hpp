// Keyframes with their edge and plane points, and those of them around a place: what LeGO-LOAM (Shan and Englot 2018)
// and LIO-SAM (Shan et al. 2020) register scans to. Clouds are moved into the map once, when a keyframe is inserted.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <tilth/core/feature_clouds.hpp>
#include <tilth/core/options.hpp>
#include <tilth/core/se3.hpp>

namespace tilth {

struct KeyframeMapOptions {
  double search_radius = 50.0;
  double density = 1.0;
  double recent = 0.0;
  bool average_indices = false;
};

template <class V>
void visit(KeyframeMapOptions& o, V&& v) {
  v("search_radius", o.search_radius, Bounds{0.1, 1e5}, "[m] keyframes farther from the sensor are not used");
  v("density", o.density, Bounds{0.01, 1e4}, "[m] side of the cells that give one keyframe each");
  v("recent", o.recent, Bounds{0, 1e6}, "[s] keyframes younger than this are used all, in addition; 0: none");
  v("average_indices", o.average_indices,
    "[-] as LeGO-LOAM: a cell gives the keyframe whose number is the mean of its keyframes' numbers, which after a "
    "revisit lies somewhere else on the way; false: the keyframe nearest to their mean position");
}

class KeyframeMap {
 public:
  explicit KeyframeMap(const KeyframeMapOptions& options) : options_(options) {}

  /// Keeps the points of a scan taken at `stamp` [s], given in the LiDAR's frame.
  void insert(double stamp, const Pose& T_map_lidar, const FeatureClouds& features_in_lidar);

  /// The numbers of the keyframes around `center` [m, in the map], one a cell, then those younger than `recent` at
  /// `stamp` [s], in the order of their insertion; a keyframe that is both comes twice, as in LIO-SAM.
  /// O(keyframes x cells).
  std::vector<std::uint32_t> surrounding(const Eigen::Vector3d& center, double stamp) const;

  /// The points of these keyframes in the map's frame, one keyframe after the other, with no other attribute.
  FeatureClouds joined(std::span<const std::uint32_t> keyframes) const;

  std::size_t size() const { return poses_.size(); }
  bool empty() const { return poses_.empty(); }
  const Pose& last_pose() const { return poses_.back(); }  ///< there must be one

 private:
  std::uint32_t nearest_to(const Eigen::Vector3d& position) const;

  KeyframeMapOptions options_;
  std::vector<double> stamps_;  // [s]
  std::vector<Pose> poses_;
  std::vector<FeatureClouds> clouds_in_map_;
};

}  // namespace tilth
