// The clouds of one topic of ROS 2 as they come: ros2:TOPIC?key=value&... A thread takes them from the middleware, so
// that whoever registers them may be late.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <tilth/core/options.hpp>
#include <tilth/sensor/scan_decoder.hpp>
#include <tilth/sources/cloud_inbox.hpp>
#include <tilth/sources/ros2_interface.hpp>

namespace tilth {

struct Ros2Options {
  CloudOptions clouds;
  std::string frame, library;
  std::uint64_t queue = 5;
  double idle = 0.0;
  bool reliable = false;
};

template <class V>
void visit(Ros2Options& o, V&& v) {
  visit(o.clouds, v);
  v("frame", o.frame, "[-] frame_id of the clouds of a topic; empty: the first one's");
  v("library", o.library, "[-] libtilth_ros2.so; empty: beside the program, in LD_LIBRARY_PATH or AMENT_PREFIX_PATH");
  v("queue", o.queue, Bounds{1, 1000}, "[scans] that may wait to be registered; then the oldest makes way");
  v("idle", o.idle, Bounds{0, 1e6}, "[s] without a cloud that end it; 0: waits for ever");
  v("reliable", o.reliable,
    "[-] ask the sender of a topic for clouds that got lost (reliable QoS); false: sensor data QoS");
}

struct Ros2Address {
  std::string topic;
  Ros2Options options;
};

/// `values` are those of Ros2Options; those in `uri` are stronger. Throws Error on what is not understood.
Ros2Address parse_ros2_uri(const std::string& uri, const OptionValues& values);

class Ros2Topic {
 public:
  /// From now on clouds are kept. `stopped` is asked ten times a second; it may be empty. `library` must outlive this.
  Ros2Topic(const TilthRos2Library& library, Ros2Address address, std::function<bool()> stopped);
  ~Ros2Topic();
  Ros2Topic(const Ros2Topic&) = delete;
  Ros2Topic& operator=(const Ros2Topic&) = delete;

  const std::string& name() const { return address_.topic; }
  const Ros2Options& options() const { return address_.options; }
  const std::shared_ptr<CloudInbox>& clouds() const { return clouds_; }

  /// Whether a cloud came, or none will, before so long.
  bool wait_for_first(std::chrono::milliseconds longest);

  std::string situation() const;          ///< who sends the topic, as it was before the first cloud
  std::string problem() const;            ///< why it ended early; empty: it did not
  void fail(const std::string& problem);  ///< it ends, for this reason
  void stop();                            ///< at once: what waits is lost

 private:
  void receive(const std::stop_token& token);
  bool take(TilthRos2Topic* topic);

  const TilthRos2Library& library_;
  Ros2Address address_;
  std::function<bool()> stopped_;
  std::shared_ptr<CloudInbox> clouds_;

  mutable std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  std::string situation_, problem_;
  bool begun_ = false, ended_ = false;

  std::jthread thread_;  // last: it uses the members above
};

/// Loads the library and listens. Throws Error as load_ros2_library does.
std::unique_ptr<Ros2Topic> listen(const Ros2Address& address, std::function<bool()> stopped);

}  // namespace tilth
