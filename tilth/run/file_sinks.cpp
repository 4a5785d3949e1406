#include <tilth/core/error.hpp>
#include <tilth/io/beam_file.hpp>
#include <tilth/io/g2o.hpp>
#include <tilth/io/las.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/io/ply.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/file_sinks.hpp>
#include <tilth/run/run_record.hpp>
#include <tilth/run/summary_json.hpp>

namespace tilth {
namespace {

using Path = std::filesystem::path;

const LoopRecord& loops_of(const Path& path, const RunRecord& run) {
  if (!run.loops) throw Error(path.string(), "cannot be written: the run had no loop closure");
  return *run.loops;
}

const LocalizationRecord& localized(const Path& path, const RunRecord& run) {
  if (!run.localization) throw Error(path.string(), "cannot be written: the run was not in a map");
  return *run.localization;
}

}  // namespace

std::unique_ptr<Sink> tum_sink(const Path& path) {
  return file_sink(path, [](const Path& to, const RunRecord& run) {
    write_tum(to, poses_of_base(run.trajectory, run.T_base_lidar));
  });
}

std::unique_ptr<Sink> kitti_sink(const Path& path) {
  return file_sink(path, [](const Path& to, const RunRecord& run) {
    write_kitti_poses(to, poses_of_base(run.trajectory, run.T_base_lidar));
  });
}

std::unique_ptr<Sink> scan_table_sink(const Path& path) {
  return file_sink(path, [](const Path& to, const RunRecord& run) { write_scan_table(to, run.scans); });
}

std::unique_ptr<Sink> summary_sink(const Path& path) {
  return file_sink(path, [](const Path& to, const RunRecord& run) { write_text(to, summary_json(run)); });
}

std::unique_ptr<Sink> beams_sink(const Path& path) {
  return file_sink(path, [](const Path& to, const RunRecord& run) {
    if (run.beams) return write_beams(to, run.beams->beams);
    std::filesystem::remove(to);  // of an earlier run
  });
}

std::unique_ptr<Sink> map_sink(const Path& path, const std::optional<UtmOrigin>& origin) {
  const std::string format = path.extension().string();
  if (format == ".pcd")
    return file_sink(path, [](const Path& to, const RunRecord& run) { write_pcd(to, run.map.records()); });
  if (format == ".ply")
    return file_sink(path, [](const Path& to, const RunRecord& run) { write_ply(to, run.map.records()); });
  if (format == ".las")
    return file_sink(path,
                     [origin](const Path& to, const RunRecord& run) { write_las(to, run.map.records(), 0.0, origin); });
  throw Error(path.string(), "is no name for a map: it must end with .pcd, .ply or .las");
}

std::unique_ptr<Sink> moving_sink(const Path& path) {
  return file_sink(path, [](const Path& to, const RunRecord& run) { write_pcd(to, to_records(run.map.moving())); });
}

std::unique_ptr<Sink> odometry_trajectory_sink(const Path& path) {
  return file_sink(path, [](const Path& to, const RunRecord& run) {
    write_tum(to, poses_of_base(loops_of(to, run).odometry, run.T_base_lidar));
  });
}

std::unique_ptr<Sink> closures_sink(const Path& path) {
  return file_sink(path, [](const Path& to, const RunRecord& run) { write_closures(to, loops_of(to, run).closures); });
}

std::unique_ptr<Sink> pose_graph_sink(const Path& path) {
  return file_sink(path, [](const Path& to, const RunRecord& run) { write_g2o(to, loops_of(to, run).graph); });
}

std::unique_ptr<Sink> hypotheses_sink(const Path& path) {
  return file_sink(
      path, [](const Path& to, const RunRecord& run) { write_hypotheses(to, localized(to, run), run.T_base_lidar); });
}

}  // namespace tilth
