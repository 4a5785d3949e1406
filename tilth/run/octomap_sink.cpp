#include <octomap/OcTree.h>
#include <sstream>

#include <tilth/core/error.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/run/grid_sink.hpp>
#include <tilth/run/octomap_sink.hpp>
#include <tilth/run/run_record.hpp>

namespace tilth {
namespace {

constexpr float kReach = 30;  // [m] that a beam is followed

/// Adds the cells before a point, as seen from where its scan was taken.
void follow(const MapPoint& point, const octomap::point3d& from, const octomap::OcTree& tree, octomap::KeySet& free) {
  const octomap::point3d to(point.x, point.y, point.z);
  octomap::KeyRay ray;
  if (!((to - from).norm() < kReach) || !tree.computeRayKeys(from, to, ray)) return;
  free.insert(ray.begin(), ray.end());
}

/// The cells of the points that stand are occupied, whatever passed them; those before any point are free.
octomap::OcTree tree_of(const RunRecord& run, double resolution) {
  octomap::OcTree tree(resolution);
  octomap::KeySet free, occupied;
  for (const std::vector<MapPoint>* points : {&run.map.points(), &run.map.moving()}) {
    for (const MapPoint& p : *points) {
      octomap::OcTreeKey key;
      if (points == &run.map.points() && tree.coordToKeyChecked(p.x, p.y, p.z, key)) occupied.insert(key);
      if (p.scan >= run.trajectory.size()) continue;
      const Eigen::Vector3f from = run.trajectory[p.scan].T_world_lidar.translation().cast<float>();
      follow(p, {from.x(), from.y(), from.z()}, tree, free);
    }
  }
  constexpr bool kLazy = true;
  for (const octomap::OcTreeKey& key : free) {
    if (occupied.find(key) == occupied.end()) tree.updateNode(key, false, kLazy);
  }
  for (const octomap::OcTreeKey& key : occupied) tree.updateNode(key, true, kLazy);
  tree.updateInnerOccupancy();
  return tree;
}

}  // namespace

std::unique_ptr<Sink> octomap_sink(const std::filesystem::path& path, double resolution) {
  return file_sink(path, [resolution](const std::filesystem::path& to, const RunRecord& run) {
    if (is_resumed(run))
      throw Error(to.string(),
                  "cannot be made of a run that was resumed: its old map does not say from where it was seen");
    octomap::OcTree tree = tree_of(run, resolution);
    std::ostringstream bytes;
    if (!tree.writeBinary(bytes)) throw Error(to.string(), "cannot be made: the OctoMap could not be serialised");
    write_text(to, bytes.str());
  });
}

}  // namespace tilth
