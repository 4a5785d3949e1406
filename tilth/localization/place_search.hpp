// Where in a whole map a scan may have been taken, from nothing: correlative matching (Olson 2009) of what stands
// upright against every pose on the map's free ground, coarse to fine. All that look alike come out, not the best one
// alone: what may be confused must be known. About 0.05 s for a building, 0.5 s for 2 km of streets.
#pragma once

#include <vector>

#include <tilth/core/options.hpp>
#include <tilth/localization/place_map.hpp>

namespace tilth {

struct PlaceSearchOptions {
  double off_way = 4.0;
  double range = 40.0;
  int max_points = 200;
  int coarse_candidates = 400;
  int max_candidates = 24;
};

template <class V>
void visit(PlaceSearchOptions& o, V&& v) {
  v("off_way", o.off_way, Bounds{0, 100}, "[m] from the way on which the map was made, at which a pose is looked for");
  v("range", o.range, Bounds{1, 1000}, "[m] patches farther from the sensor are not compared");
  v("max_points", o.max_points, Bounds{10, 100000}, "[patches] that are compared, evenly over the cells they lie in");
  v("coarse_candidates", o.coarse_candidates, Bounds{1, 1e6}, "[-] poses of the coarse search that are refined");
  v("max_candidates", o.max_candidates, Bounds{1, 10000}, "[-] poses that are handed on");
}

struct PlaceCandidate {
  Pose T_map_lidar = Pose::Identity();
  double score = 0.0;  ///< [-] of the best that could be, in [0, 1]
};

class PlaceSearch {
 public:
  PlaceSearch(const PlaceMap& map, const PlaceSearchOptions& options);

  /// The poses at which `patches`, in a LiDAR's frame that is about level, may have been seen: best first, each the
  /// best of those around it. Empty where nothing stands upright.
  std::vector<PlaceCandidate> find(const SurfacePatches& patches) const;

 private:
  /// What a patch looks for at one heading.
  struct Sought {
    std::int32_t dx, dy;  // [cells] from the sensor
    std::uint8_t facings;
  };
  struct Peak {
    std::int32_t x = 0, y = 0;  // [cells]
    int yaw = 0;                // [steps]
    int score = 0;
  };

  std::size_t index(std::int32_t x, std::int32_t y) const {
    return std::size_t(y - low_y_) * std::size_t(width_) + std::size_t(x - low_x_);
  }
  bool holds(std::int32_t x, std::int32_t y) const {
    return x > low_x_ && y > low_y_ && x < low_x_ + width_ - 1 && y < low_y_ + height_ - 1;
  }
  void draw_grids();
  void find_free_ground();
  std::vector<Sought> sought(const SurfacePatches& patches, int yaw) const;
  std::vector<Peak> coarse(const SurfacePatches& patches) const;
  void coarse_at(const std::vector<Sought>& sought, int yaw, std::vector<Peak>& peaks) const;
  int score(const std::vector<Sought>& sought, std::int32_t x, std::int32_t y) const;
  Peak refined(const Peak& start, const std::vector<std::vector<Sought>>& by_yaw) const;

  const PlaceMap& map_;
  PlaceSearchOptions options_;
  std::int32_t low_x_ = 0, low_y_ = 0, width_ = 0, height_ = 0;  // [cells]
  std::vector<std::uint8_t> exact_, near_;                       // facings in a cell; in and about it
  struct Ground {
    std::int32_t x, y;
    double z;  // [m] of the sensor
  };
  std::vector<Ground> ground_;
};

}  // namespace tilth
