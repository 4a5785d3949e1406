#include <chrono>
#include <utility>

#include <tilth/messages/pose_estimate.hpp>
#include <tilth/node/node_work.hpp>
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

/// A task at work, behind the door.
class NodeWork::Inside {
 public:
  Inside(NodeWork& work, NodeTask& task) : work_(work) {
    work_.door_.shut();
    work_.task_ = &task;
  }
  ~Inside() {
    work_.task_ = nullptr;
    work_.door_.open();
  }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

 private:
  NodeWork& work_;
};

NodeWork::NodeWork(const OptionValues& parameters, NodeOutlet& outlet)
    : parameters_(parameters), settings_(read_settings(parameters)), outlet_(outlet) {
  if (!settings_.node.map.empty()) map_.emplace(settings_.node.map);
  inbox_ = std::make_shared<CloudInbox>(settings_.node.running.queue);
  thread_ = std::jthread([this](const std::stop_token& stop) {
    while (!stop.stop_requested()) work();
  });
}

NodeWork::~NodeWork() {
  thread_.request_stop();
  const std::lock_guard lock(mutex_);
  stopping_ = true;
  inbox_->close();
}

std::shared_ptr<CloudInbox> NodeWork::inbox() {
  const std::lock_guard lock(mutex_);
  if (inbox_->ended() && !stopping_) inbox_ = std::make_shared<CloudInbox>(settings_.node.running.queue);
  return inbox_;
}

void NodeWork::take_static_transforms(std::span<const std::byte> message) {
  try {
    fixed_.add(message, outlet_.serialization());
  } catch (const Error& error) {
    outlet_.warn(error.what());
  }
}

void NodeWork::take_guess(std::span<const std::byte> message) {
  try {
    const PoseGuess guess = parse_pose_guess(message, outlet_.serialization());
    if (!map_) throw Error("initialpose", "there is no map to be found in: it is named by map");
    if (guess.world != settings_.node.map_frame)
      throw Error("initialpose", "is in the frame '" + guess.world + "', expected '" + settings_.node.map_frame + "'");
    door_.visit([&] {
      if (task_ == nullptr)
        T_map_body_ = guess.T_world_body;
      else
        outlet_.note(task_->localize(guess.T_world_body));
    });
  } catch (const std::exception& error) {
    outlet_.warn(error.what());
  }
}

std::vector<NodeParameter> NodeWork::parameters() {
  const std::lock_guard lock(mutex_);
  return node_parameters(parameters_);
}

void NodeWork::set(const OptionValues& values) {
  door_.visit([&] {
    const std::lock_guard lock(mutex_);
    OptionValues all = values;
    all.insert(parameters_.begin(), parameters_.end());
    read_settings(all);
    settings_.node.running = set_running(settings_.node.running, values);
    inbox_->limit(settings_.node.running.queue);
    parameters_ = std::move(all);
  });
}

void NodeWork::work() {
  const std::shared_ptr<CloudInbox> clouds = inbox();
  try {
    run(clouds);
  } catch (const std::exception& error) {
    if (!clouds->ended()) outlet_.warn("begins anew: " + std::string(error.what()));
  }
  clouds->close();
}

void NodeWork::run(const std::shared_ptr<CloudInbox>& clouds) {
  const auto frame = std::make_shared<std::string>(settings_.node.lidar_frame);
  auto source = open_clouds(clouds_of(clouds, frame, outlet_), settings_.node.lidar_frame, settings_.clouds, {});
  const std::string lidar = frame->empty() ? body_of({}) : *frame;
  if (settings_.node.mount_from_tf && !find_mount(lidar, *clouds)) return;
  const NodeSurroundings around{settings_, *clouds, outlet_};
  std::unique_ptr<ScanSource> scans = behind(door_, std::move(source));
  const std::unique_ptr<NodeTask> task =
      map_ ? localizing_task(around, std::move(scans), lidar, *map_) : mapping_task(around, std::move(scans), lidar);
  const Inside inside(*this, *task);
  if (T_map_body_) task->localize(std::exchange(T_map_body_, std::nullopt));
  task->run();
}

/// Waits for it as long as there are clouds.
bool NodeWork::find_mount(const std::string& lidar, const CloudInbox& clouds) {
  constexpr std::chrono::milliseconds kBetweenLooks(100);
  const std::string& base = settings_.node.base_frame;
  for (bool said = false; !clouds.ended(); said = true) {
    settings_.T_base_lidar = fixed_.wait_for(base, lidar, kBetweenLooks);
    if (settings_.T_base_lidar) return true;
    if (!said) outlet_.warn("waits for /tf_static to tell how " + lidar + " is mounted on " + base);
  }
  return false;
}

}  // namespace tilth
