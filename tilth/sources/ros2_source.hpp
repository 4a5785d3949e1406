// Scans of the clouds of a topic of ROS 2 while they come. Where the caller is too slow the newest cloud wins; what is
// decided of their fields and stamps is decided as of a recording.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <tilth/sources/live_scans.hpp>
#include <tilth/sources/ros2_topic.hpp>

namespace tilth {

class Ros2Source : public LiveScans {
 public:
  /// Waits for the first clouds, which decide what their fields mean and are scans then. Ends where stamps fall back by
  /// more than a second, and says so. Throws Error where it ends before a cloud that can be read came.
  explicit Ros2Source(std::unique_ptr<Ros2Topic> topic);
  ~Ros2Source() override;
  Ros2Source(const Ros2Source&) = delete;
  Ros2Source& operator=(const Ros2Source&) = delete;

  std::optional<Scan> next() override;
  std::vector<std::string> notices() const override;
  Losses losses() const override;

 private:
  void take_words();

  std::unique_ptr<Ros2Topic> topic_;
  std::unique_ptr<ScanSource> scans_;  // reads the topic's clouds
};

}  // namespace tilth
