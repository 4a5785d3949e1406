#include <sstream>

#include <tilth/core/error.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/pgm.hpp>
#include <tilth/run/grid_sink.hpp>
#include <tilth/run/run_record.hpp>

namespace tilth {
namespace {

std::uint8_t grey_of(Occupancy occupancy) {
  switch (occupancy) {
    case Occupancy::free: return 254;
    case Occupancy::occupied: return 0;
    case Occupancy::unknown: break;
  }
  return 205;
}

}  // namespace

void write_plan_image(const std::filesystem::path& path, const OccupancyGrid& grid) {
  std::vector<std::uint8_t> pixels;
  pixels.reserve(grid.cells.size());
  for (int row = grid.rows; row-- > 0;) {
    for (int column = 0; column < grid.columns; ++column) pixels.push_back(grey_of(grid.at(column, row)));
  }
  write_pgm(path, grid.columns, pixels);
}

void write_plan_yaml(const std::filesystem::path& path, const OccupancyGrid& grid, const std::string& image) {
  std::ostringstream text;
  text.precision(12);
  text << "image: " << image << "\nmode: trinary\nresolution: " << grid.resolution << "\norigin: [" << grid.origin.x()
       << ", " << grid.origin.y() << ", 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
  write_text(path, text.str());
}

bool is_resumed(const RunRecord& record) {
  return record.trajectory.size() != record.scans.rows.size();
}

OccupancyGrid occupancy_of(const RunRecord& record, const OccupancyOptions& options) {
  std::vector<Eigen::Vector3f> way;
  for (const StampedPose& pose : record.trajectory) way.push_back(pose.T_world_lidar.translation().cast<float>());
  std::vector<SeenPoint> seen;
  const auto add = [&](const std::vector<MapPoint>& points, bool moving) {
    for (const MapPoint& p : points) {
      if (p.scan < way.size()) seen.push_back({{p.x, p.y, p.z}, way[p.scan], moving});
    }
  };
  add(record.map.points(), false);
  add(record.map.moving(), true);
  return occupancy_of(seen, way, options);
}

const OccupancyGrid& PlanOfRun::of(const RunRecord& record) {
  if (is_resumed(record))
    throw Error("map.pgm", "cannot be made of a run that was resumed: its old map does not say from where it was seen");
  if (!grid_) grid_ = occupancy_of(record, options_);
  return *grid_;
}

std::unique_ptr<Sink> grid_image_sink(const std::filesystem::path& path, std::shared_ptr<PlanOfRun> plan) {
  return file_sink(path, [plan = std::move(plan)](const std::filesystem::path& to, const RunRecord& run) {
    write_plan_image(to, plan->of(run));
  });
}

std::unique_ptr<Sink> grid_yaml_sink(const std::filesystem::path& path, std::shared_ptr<PlanOfRun> plan) {
  return file_sink(path, [plan = std::move(plan)](const std::filesystem::path& to, const RunRecord& run) {
    write_plan_yaml(to, plan->of(run), "map.pgm");
  });
}

}  // namespace tilth
