#include <tilth/plot/motion_curves.hpp>
#include <tilth/report/run_sections.hpp>
#include <tilth/run/base_frame.hpp>

namespace tilth {
namespace {

const Axis kTime{"time", "s"};

Plot over_time(std::string id, std::string title, Axis y, std::vector<Curve> curves) {
  Plot plot;
  plot.id = std::move(id);
  plot.title = std::move(title);
  plot.x = kTime;
  plot.y = std::move(y);
  plot.over_time = true;
  plot.curves = std::move(curves);
  return plot;
}

/// The positions of the poses with these numbers, from above.
Curve places_of(const Trajectory& path, const std::vector<std::size_t>& numbers, const std::string& name) {
  Curve places{name, {}, {}, {}};
  for (const std::size_t i : numbers) {
    places.x.push_back(float(path[i].T_world_lidar.translation().x()));
    places.y.push_back(float(path[i].T_world_lidar.translation().y()));
  }
  return places;
}

void add_loops(const Trajectory& path, const LoopRecord& loops, Plot& top) {
  top.dots = places_of(path, loops.keyframe_scans, "keyframes");
  std::vector<std::size_t> ends;
  for (const auto& [from, to] : accepted_scans(loops)) ends.insert(ends.end(), {from, to});
  top.links = places_of(path, ends, "loop closures");
}

std::string body_in_words(const RunRecord& record) {
  return record.T_base_lidar ? "robot (base_link)" : "LiDAR";
}

}  // namespace

Section path_section(const RunRecord& record, const std::optional<JudgedRun>& judged) {
  const double start = record.trajectory.empty() ? 0.0 : record.trajectory.front().stamp;
  const auto of_base = [&](const Trajectory& poses) { return poses_of_base(poses, record.T_base_lidar); };
  std::vector<std::pair<std::string, Trajectory>> paths{{record.pipeline, of_base(record.trajectory)}};
  if (record.loops) paths.emplace_back(kBeforeLoops, of_base(record.loops->odometry));
  if (judged) paths.emplace_back("truth", judged->truth_in_world);
  std::vector<Curve> above, roll, pitch, yaw, speed, height;
  for (const auto& [name, path] : paths) {
    above.push_back(path_curve(path, name));
    AngleCurves angles = angle_curves(path, start, name);
    roll.push_back(std::move(angles.roll));
    pitch.push_back(std::move(angles.pitch));
    yaw.push_back(std::move(angles.yaw));
    speed.push_back(speed_curve(path, start, name));
    height.push_back(height_curve(path, start, name));
  }
  for (std::vector<Curve>* curves : {&above, &roll, &pitch, &yaw, &speed, &height}) {
    if (judged) curves->back().truth = true;
    if (record.loops) (*curves)[1].behind = true;
  }
  Section section{"way", "The way", "", {}, {}};
  Plot top;
  top.id = "top_view";
  top.title = "Trajectory from above";
  top.note = "The dot marks the start. The world is the " + body_in_words(record) + " at its first pose" +
             (record.floor ? ", made level" : "") + ": x ahead, y to the left.";
  top.kind = PlotKind::path;
  top.x = {"x", "m"};
  top.y = {"y", "m"};
  top.curves = std::move(above);
  if (record.loops) add_loops(paths.front().second, *record.loops, top);
  section.plots.push_back(std::move(top));
  section.plots.push_back(over_time("speed", "Speed", {"speed", "m/s"}, std::move(speed)));
  section.plots.back().note = "Distance of the pose before and the pose after, divided by the time between.";
  section.plots.push_back(over_time("roll", "Roll", {"roll", "deg"}, std::move(roll)));
  section.plots.push_back(over_time("pitch", "Pitch", {"pitch", "deg"}, std::move(pitch)));
  section.plots.push_back(over_time("yaw", "Yaw", {"yaw", "deg"}, std::move(yaw)));
  section.plots.push_back(over_time("height", "Height", {"z", "m"}, std::move(height)));
  return section;
}

}  // namespace tilth
