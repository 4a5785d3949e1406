#include <filesystem>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/node/node_sink.hpp>
#include <tilth/node/node_task.hpp>
#include <tilth/node/outlet_observer.hpp>
#include <tilth/odometry/continued_odometry.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/saved_map_sink.hpp>
#include <tilth/run/session.hpp>

namespace tilth {
namespace {

Pipeline new_pipeline(const NodeSettings& settings) {
  Pipeline pipeline{make_odometry(settings.node.pipeline, settings.pipeline)};
  if (settings.T_base_lidar)
    pipeline.odometry = std::make_unique<ContinuedOdometry>(std::move(pipeline.odometry), *settings.T_base_lidar);
  return settings.node.loop_closure ? with_loop_closure(std::move(pipeline), settings.slam) : std::move(pipeline);
}

class MappingTask final : public NodeTask {
 public:
  MappingTask(const NodeSurroundings& around, std::unique_ptr<ScanSource> source, const std::string& lidar_frame,
              Pipeline pipeline)
      : around_(around),
        observer_(around.outlet),
        slam_(std::exchange(pipeline.slam, nullptr)),  // a session would close loops once more when it ends
        session_(std::move(source), std::move(pipeline), new_record(around.settings)) {
    session_.observe(observer_);
    session_.add(std::make_unique<NodeSink>(around, slam_, lidar_frame));
  }

  void run() override {
    session_.run();
    for (const std::string& failure : session_.finish()) around_.outlet.warn(failure);
  }

  std::string save_map() override {
    const RunRecord& record = session_.record();
    if (record.trajectory.empty()) throw Error("save_map", "no scan is registered yet");
    const std::filesystem::path folder = around_.settings.node.running.save_map;
    std::filesystem::create_directories(folder);
    const Trajectory way = way_in_map(record, slam_);
    MapBuilder map = map_of(record, slam_);
    map.settle();
    write_tum(folder / "trajectory.tum", poses_of_base(way, record.T_base_lidar));
    write_pcd(folder / "map.pcd", map.records());
    if (slam_ != nullptr) saved_map_sink({folder / "places", {}, {}, {}}, *slam_)->finish(record);
    return std::to_string(way.size()) + " poses and " + std::to_string(map.size()) + " points in " + folder.string();
  }

  std::string localize(const std::optional<Pose>&) override {
    throw Error("localize", "there is no map to be found in: it is named by map");
  }

 private:
  NodeSurroundings around_;
  OutletObserver observer_;
  Slam* slam_;
  Session session_;
};

}  // namespace

std::unique_ptr<NodeTask> mapping_task(const NodeSurroundings& around, std::unique_ptr<ScanSource> source,
                                       const std::string& lidar_frame) {
  return std::make_unique<MappingTask>(around, std::move(source), lidar_frame, new_pipeline(around.settings));
}

}  // namespace tilth
