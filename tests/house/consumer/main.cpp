// Uses one function of every installed library; ends with zero where all of them answer as they should.
#include <tilth/core/trajectory.hpp>
#include <tilth/gazebo/world_file.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/report/run_outputs.hpp>
#include <tilth/simulation/scenes.hpp>
#include <tilth/tilth.hpp>

namespace {

bool refuses_no_world() {
  try {
    tilth::read_world_file("there_is_none.sdf", {});
    return false;
  } catch (const tilth::Error&) {
    return true;
  }
}

}  // namespace

int main() {
  const tilth::Trajectory trajectory{{0.0, tilth::Pose::Identity()}, {1.0, tilth::Pose(Eigen::Translation3d(3, 4, 0))}};
  tilth::write_tum("trajectory.tum", trajectory);
  const bool read_back = tilth::path_length(tilth::read_tum("trajectory.tum")) == 5.0;
  tilth::Slam slam(tilth::make_odometry(tilth::pipelines().front().name), {});
  slam.finish();
  const bool simulates = !tilth::corridor({}).mesh.triangles.empty();
  const bool writes = !tilth::run_outputs({}, {}, false).empty();
  return read_back && slam.trajectory().empty() && simulates && refuses_no_world() && writes ? 0 : 1;
}
