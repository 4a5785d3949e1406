// The floor plan of a run as ROS map servers read it: map.pgm and map.yaml. docs/grid.md describes both.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <tilth/freespace/occupancy_grid.hpp>
#include <tilth/run/sink.hpp>

namespace tilth {

/// Whether the run goes on with an earlier one, of which there are poses and a map, but no rows: then nobody knows from
/// where its old points were seen.
bool is_resumed(const RunRecord& record);

/// The plan of a run whose map is settled.
OccupancyGrid occupancy_of(const RunRecord& record, const OccupancyOptions& options);

/// Works the plan out once, whichever file of it is written first.
class PlanOfRun {
 public:
  explicit PlanOfRun(const OccupancyOptions& options) : options_(options) {}
  const OccupancyGrid& of(const RunRecord& record);
  const OccupancyOptions& options() const { return options_; }

 private:
  OccupancyOptions options_;
  std::optional<OccupancyGrid> grid_;
};

/// The two files of a plan; `image` is the name that the .yaml has for the other one. Throw Error where they cannot be
/// written in full.
void write_plan_image(const std::filesystem::path& path, const OccupancyGrid& grid);
void write_plan_yaml(const std::filesystem::path& path, const OccupancyGrid& grid, const std::string& image);

std::unique_ptr<Sink> grid_image_sink(const std::filesystem::path& path, std::shared_ptr<PlanOfRun> plan);
std::unique_ptr<Sink> grid_yaml_sink(const std::filesystem::path& path, std::shared_ptr<PlanOfRun> plan);

}  // namespace tilth
