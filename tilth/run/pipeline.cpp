#include <utility>

#include <tilth/localization/join_pieces.hpp>
#include <tilth/run/pipeline.hpp>
#include <tilth/run/stopwatch.hpp>

namespace tilth {
namespace {

template <class E>
std::string name_of(E value) {
  return std::string(names_of(value)[std::size_t(value)]);
}

ClosureRow row_of(const LoopClosure& closure, const std::vector<Keyframe>& keyframes) {
  const Keyframe &from = keyframes[closure.constraint.from], &to = keyframes[closure.constraint.to];
  ClosureRow row;
  row.from_scan = from.scan, row.to_scan = to.scan;
  row.from_stamp = from.stamp, row.to_stamp = to.stamp;
  row.constraint = closure.constraint;
  row.found_by = name_of(closure.found_by), row.verdict = name_of(closure.verdict);
  row.overlap = closure.overlap, row.back_overlap = closure.back_overlap;
  row.landmarks = closure.landmarks, row.fitness = closure.fitness;
  row.degenerate_directions = closure.degenerate_directions;
  row.squared_error = closure.squared_error;
  return row;
}

/// What was right only relative to itself is right again, as the one scan says that stands for "found again".
void believe_joined(const Slam& slam, ScanTable& scans) {
  for (const auto& [first, last] : slam.joined_scans()) {
    bool found = false;
    for (std::size_t i = first; i < last; ++i) {
      Track& track = scans.rows[i].track;
      if (track.state != TrackState::lost || track.reason != TrackReason::new_map) continue;
      track = std::exchange(found, true) ? Track{} : Track{TrackState::recovered, TrackReason::joined};
    }
  }
}

}  // namespace

std::vector<Pose> corrections(const Trajectory& before, const Trajectory& after) {
  std::vector<Pose> T_after_before;
  for (std::size_t i = 0; i < before.size(); ++i)
    T_after_before.push_back(after[i].T_world_lidar * before[i].T_world_lidar.inverse());
  return T_after_before;
}

Pipeline with_loop_closure(Pipeline pipeline, const SlamOptions& options) {
  auto around = std::make_unique<Slam>(std::move(pipeline.odometry), options);
  around->after_keyframe(PieceJoiner({}));
  pipeline.slam = around.get();
  pipeline.odometry = std::move(around);
  return pipeline;
}

void close_loops(Slam& slam, RunRecord& record) {
  const Stopwatch stopwatch;
  slam.finish();
  join_pieces(slam.loops(), {});
  const LoopCloser& closer = slam.loops();
  LoopRecord loops{.odometry = record.trajectory, .graph = closer.graph()};
  for (const Keyframe& keyframe : closer.keyframes()) loops.keyframe_scans.push_back(keyframe.scan);
  for (const LoopClosure& closure : closer.closures()) loops.closures.push_back(row_of(closure, closer.keyframes()));
  loops.optimizations = closer.optimizations();
  loops.times = slam.loop_times();
  record.trajectory = slam.trajectory();
  record.T_map_odom.reset();
  believe_joined(slam, record.scans);
  record.map.move(corrections(loops.odometry, record.trajectory));
  loops.finish_ms = stopwatch.milliseconds();
  record.loops = std::move(loops);
}

}  // namespace tilth
