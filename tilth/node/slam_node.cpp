#include <filesystem>
#include <thread>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/io/trajectory_file.hpp>
#include <tilth/node/node_sink.hpp>
#include <tilth/node/session_door.hpp>
#include <tilth/node/slam_node.hpp>
#include <tilth/odometry/continued_odometry.hpp>
#include <tilth/odometry/make_odometry.hpp>
#include <tilth/run/base_frame.hpp>
#include <tilth/run/new_record.hpp>
#include <tilth/run/saved_map_sink.hpp>
#include <tilth/run/session.hpp>
#include <tilth/sources/cloud_source.hpp>

namespace tilth {
namespace {

constexpr const char* kTopic = "topic points";
constexpr double kFallBack = 1.0;  // [s]; a cloud that is late by less is only left out

class OutletObserver final : public RunObserver {
 public:
  explicit OutletObserver(NodeOutlet& outlet) : outlet_(outlet) {}
  void note(const std::string& sentence) override { outlet_.note(sentence); }
  void warn(const std::string& sentence) override { outlet_.warn(sentence); }

 private:
  NodeOutlet& outlet_;
};

/// Messages of the inbox, to its end, or until the stamps of one frame fall back: then a recording is played anew.
/// `frame` becomes that of the first message, where it is empty.
CloudFeed feed_of(const std::shared_ptr<CloudInbox>& inbox, const std::shared_ptr<std::string>& frame,
                  NodeOutlet& outlet) {
  CloudFeed feed{.name = kTopic, .next = {}, .trust = StampTrust::believed};
  feed.next = [inbox, frame, &outlet, last = 0.0]() mutable {
    std::optional<Message> message = inbox->pop();
    if (!message) return message;
    const auto header = RosMessageReader(message->bytes, Serialization::cdr, "PointCloud2").header();
    if (frame->empty()) *frame = header.frame_id;
    if (header.frame_id != *frame) return message;
    if (header.stamp < last - kFallBack) {
      outlet.warn("the stamps of the clouds fall back by " + std::to_string(last - header.stamp) + " s: begins anew");
      inbox->close();
      message.reset();
    }
    last = header.stamp;
    return message;
  };
  return feed;
}

}  // namespace

/// One session after the other, each with an inbox of its own.
class SlamNode::Work {
 public:
  Work(const OptionValues& parameters, NodeOutlet& outlet) : settings_(read_settings(parameters)), outlet_(outlet) {
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
    if (inbox_->closed() && !stopping_) inbox_ = std::make_shared<CloudInbox>(settings_.node.queue);
    return inbox_;
  }

  std::string save_map() {
    return door_.visit([&] {
      if (session_ == nullptr || session_->record().trajectory.empty())
        throw Error("save_map", "no scan is registered yet");
      return write_map(session_->record());
    });
  }

 private:
  void work() {
    const std::shared_ptr<CloudInbox> clouds = inbox();
    try {
      run(clouds);
    } catch (const std::exception& error) {
      if (!clouds->closed()) outlet_.warn("begins anew: " + std::string(error.what()));
    }
    clouds->close();
  }

  void run(const std::shared_ptr<CloudInbox>& clouds) {
    const auto frame = std::make_shared<std::string>(settings_.node.lidar_frame);
    auto source = open_clouds(feed_of(clouds, frame, outlet_), settings_.node.lidar_frame, settings_.clouds, {});
    RunRecord record = new_record(kTopic, settings_.node.pipeline, settings_.pipeline);
    record.T_base_lidar = settings_.T_base_lidar;
    record.map = MapBuilder(settings_.map);
    Pipeline pipeline = new_pipeline();
    slam_ = std::exchange(pipeline.slam, nullptr);  // a session would close loops once more when it ends
    Session session(behind(door_, std::move(source)), std::move(pipeline), std::move(record));
    OutletObserver observer(outlet_);
    session.observe(observer);
    const std::string lidar = frame->empty() ? body_of({}) : *frame;
    session.add(std::make_unique<NodeSink>(NodeSink::Surroundings{settings_, *clouds, slam_, outlet_}, lidar));
    run(session);
  }

  void run(Session& session) {
    struct Inside {
      Work& work;
      ~Inside() {
        work.session_ = nullptr;
        work.door_.open();
      }
    };
    door_.shut();
    const Inside inside{*this};
    session_ = &session;
    session.run();
    for (const std::string& failure : session.finish()) outlet_.warn(failure);
  }

  Pipeline new_pipeline() const {
    Pipeline pipeline{make_odometry(settings_.node.pipeline, settings_.pipeline)};
    if (settings_.T_base_lidar)
      pipeline.odometry = std::make_unique<ContinuedOdometry>(std::move(pipeline.odometry), *settings_.T_base_lidar);
    return settings_.node.loop_closure ? with_loop_closure(std::move(pipeline), settings_.slam) : std::move(pipeline);
  }

  std::string write_map(const RunRecord& record) const {
    const std::filesystem::path folder = settings_.node.save_map;
    std::filesystem::create_directories(folder);
    const Trajectory way = way_in_map(record, slam_);
    MapBuilder map = map_of(record, slam_);
    map.settle();
    write_tum(folder / "trajectory.tum", poses_of_base(way, record.T_base_lidar));
    write_pcd(folder / "map.pcd", map.records());
    if (slam_ != nullptr) saved_map_sink({folder / "places", {}, {}, {}}, *slam_)->finish(record);
    return std::to_string(way.size()) + " poses and " + std::to_string(map.size()) + " points in " + folder.string();
  }

  NodeSettings settings_;
  NodeOutlet& outlet_;
  SessionDoor door_;
  Session* session_ = nullptr;  // behind the door, as what follows
  Slam* slam_ = nullptr;
  std::mutex mutex_;  // of what follows
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

void SlamNode::lose(std::size_t count) {
  work_->inbox()->lose(count);
}

void SlamNode::reset() {
  work_->inbox()->close();
}

std::string SlamNode::save_map() {
  return work_->save_map();
}

}  // namespace tilth
