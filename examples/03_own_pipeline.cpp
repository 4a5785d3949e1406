// A pipeline of your own, put together from the rooms: crop, patches of surface, deskew, GICP to a map of Gaussians.
//
//   03_own_pipeline RECORDING > trajectory.tum
#include <iostream>

#include <tilth/features/surface_patches.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/map/patch_map.hpp>
#include <tilth/odometry/motion_model.hpp>
#include <tilth/preprocess/crop.hpp>
#include <tilth/preprocess/deskew.hpp>
#include <tilth/registration/association.hpp>
#include <tilth/sources/open_source.hpp>
#include <tilth/tilth.hpp>

class MyOdometry : public tilth::Odometry {
 public:
  tilth::OdometryResult register_scan(const tilth::Scan& scan) override {
    tilth::OdometryResult result;
    result.filtered = tilth::crop_range(scan.cloud, 0.5, 100.0);
    const double middle = 0.5 * tilth::duration(result.filtered);
    result.stamp = scan.stamp + middle;
    result.motion = tilth::MotionInScan::steady(motion_.velocity(), middle);
    tilth::MatchedPatches<tilth::MapSurface> patches{
        tilth::deskew(tilth::surface_patches(result.filtered, {}), result.motion, middle)};

    result.alignment = align(patches, motion_.predict(result.stamp));
    result.T_world_lidar = result.alignment.T_target_source;
    motion_.update(result.stamp, result.T_world_lidar);
    map_.insert(patches.patches, result.T_world_lidar);
    map_.crop(result.T_world_lidar.translation());
    return result;
  }

  tilth::PointCloud local_map() const override {
    tilth::PointCloud map_in_world;
    map_in_world.points = map_.means();
    return map_in_world;
  }

 private:
  tilth::AlignResult align(tilth::MatchedPatches<tilth::MapSurface>& patches, const tilth::Pose& T_start) const {
    if (motion_.updates() == 0) return {.T_target_source = T_start, .converged = true};
    return tilth::align(T_start, {}, [&](const tilth::Pose& T) {
      return tilth::associate_distributions(patches, T, map_, {.max_distance = 0.5});
    });
  }

  tilth::PatchMap map_{tilth::PatchMapOptions{}};
  tilth::ConstantVelocity motion_;
};

int main(int argc, char** argv) {
  if (argc != 2) return std::cerr << "usage: 03_own_pipeline RECORDING\n", 2;
  const auto source = tilth::open_source(argv[1]);
  MyOdometry odometry;
  while (const auto scan = source->next()) {
    const tilth::OdometryResult result = odometry.register_scan(*scan);
    std::cout << tilth::tum_line({result.stamp, result.T_world_lidar});
  }
}
