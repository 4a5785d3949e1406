#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include <tilth/atlas/map_folder.hpp>
#include <tilth/core/error.hpp>
#include <tilth/node/node_task.hpp>
#include <tilth/node/session_door.hpp>
#include <tilth/node/slam_node.hpp>
#include <tilth/node/static_transforms.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/sources/cloud_source.hpp>

namespace tilth {
namespace {

/// Messages of the inbox, to its end; `frame` becomes that of the first message, where it is empty.
CloudFeed clouds_of(const std::shared_ptr<CloudInbox>& inbox, const std::shared_ptr<std::string>& frame,
                    NodeOutlet& outlet) {
  return feed_of(inbox, {kCloudTopic, frame, outlet.serialization(),
                         [&outlet](const std::string& how) { outlet.warn(how + ": begins anew"); }});
}

}  // namespace

/// One session after the other, each with an inbox of its own.
class SlamNode::Work {
 public:
  Work(const OptionValues& parameters, NodeOutlet& outlet) : settings_(read_settings(parameters)), outlet_(outlet) {
    if (!settings_.node.map.empty()) map_.emplace(settings_.node.map);
    inbox_ = std::make_shared<CloudInbox>(settings_.node.queue);
    thread_ = std::jthread([this](const std::stop_token& stop) {
      while (!stop.stop_requested()) work();
    });
  }

  ~Work() {
    thread_.request_stop();
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    inbox_->close();
  }

  /// That of the next session, where the last one is over or about to be.
  std::shared_ptr<CloudInbox> inbox() {
    const std::lock_guard lock(mutex_);
    if (inbox_->ended() && !stopping_) inbox_ = std::make_shared<CloudInbox>(settings_.node.queue);
    return inbox_;
  }

  void take_static_transforms(std::span<const std::byte> message) {
    try {
      fixed_.add(message, outlet_.serialization());
    } catch (const Error& error) {
      outlet_.warn(error.what());
    }
  }

  /// Calls one of the task's, while that waits for a scan.
  std::string ask(std::string (NodeTask::*service)(), const char* name) {
    return door_.visit([&] {
      if (task_ == nullptr) throw Error(name, "no scan is registered yet");
      return (task_->*service)();
    });
  }

 private:
  void work() {
    const std::shared_ptr<CloudInbox> clouds = inbox();
    try {
      run(clouds);
    } catch (const std::exception& error) {
      if (!clouds->ended()) outlet_.warn("begins anew: " + std::string(error.what()));
    }
    clouds->close();
  }

  void run(const std::shared_ptr<CloudInbox>& clouds) {
    const auto frame = std::make_shared<std::string>(settings_.node.lidar_frame);
    auto source = open_clouds(clouds_of(clouds, frame, outlet_), settings_.node.lidar_frame, settings_.clouds, {});
    const std::string lidar = frame->empty() ? body_of({}) : *frame;
    if (settings_.node.mount_from_tf && !find_mount(lidar, *clouds)) return;
    const NodeSurroundings around{settings_, *clouds, outlet_};
    std::unique_ptr<ScanSource> scans = behind(door_, std::move(source));
    const std::unique_ptr<NodeTask> task =
        map_ ? localizing_task(around, std::move(scans), lidar, *map_) : mapping_task(around, std::move(scans), lidar);
    struct Inside {
      Work& work;
      ~Inside() {
        work.task_ = nullptr;
        work.door_.open();
      }
    };
    door_.shut();
    const Inside inside{*this};
    task_ = task.get();
    task->run();
  }

  /// Waits for it as long as there are clouds.
  bool find_mount(const std::string& lidar, const CloudInbox& clouds) {
    constexpr std::chrono::milliseconds kBetweenLooks(100);
    const std::string& base = settings_.node.base_frame;
    for (bool said = false; !clouds.ended(); said = true) {
      settings_.T_base_lidar = fixed_.wait_for(base, lidar, kBetweenLooks);
      if (settings_.T_base_lidar) return true;
      if (!said) outlet_.warn("waits for /tf_static to tell how " + lidar + " is mounted on " + base);
    }
    return false;
  }

  NodeSettings settings_;  // the mount in it is the working thread's
  NodeOutlet& outlet_;
  StaticTransforms fixed_;
  std::optional<MapFolder> map_;  // to be found in
  SessionDoor door_;
  NodeTask* task_ = nullptr;  // behind the door
  std::mutex mutex_;          // of what follows
  std::shared_ptr<CloudInbox> inbox_;
  bool stopping_ = false;
  std::jthread thread_;  // last: it uses the members above
};

SlamNode::SlamNode(const OptionValues& parameters, NodeOutlet& outlet)
    : work_(std::make_unique<Work>(parameters, outlet)) {}

SlamNode::~SlamNode() = default;

void SlamNode::take(std::vector<std::byte> cloud, std::uint64_t arrival) {
  work_->inbox()->push({0, arrival, std::move(cloud)});
}

void SlamNode::take_static_transforms(std::span<const std::byte> message) {
  work_->take_static_transforms(message);
}

void SlamNode::lose(std::size_t count) {
  work_->inbox()->lose(count);
}

void SlamNode::reset() {
  work_->inbox()->close();
}

std::string SlamNode::save_map() {
  return work_->ask(&NodeTask::save_map, "save_map");
}

std::string SlamNode::localize() {
  return work_->ask(&NodeTask::localize, "localize");
}

SlamNode::Answer SlamNode::serve(const std::string& name) {
  try {
    if (name == "save_map") return {true, save_map()};
    if (name == "localize") return {true, localize()};
    if (name != "reset") throw Error(name, "is no service of this node");
    reset();
    return {true, "begins anew with the next clouds"};
  } catch (const std::exception& error) {
    return {false, error.what()};
  }
}

}  // namespace tilth
