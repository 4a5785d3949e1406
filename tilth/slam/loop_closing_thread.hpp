// Loops closed on a thread of their own, so that no scan waits for them. Keyframes are worked off in the order in which
// they come and nothing looks at a clock, so what comes of them is the same to the bit, whenever it is asked for.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <tilth/slam/loop_closer.hpp>

namespace tilth {

/// What closing loops has cost so far, beside the scans.
struct LoopTimes {
  double detection_ms = 0.0, verification_ms = 0.0, graph_ms = 0.0;  ///< in sum
  double longest_wait_ms = 0.0;  ///< from a keyframe that comes to when its loops are closed, at most
};

class LoopClosingThread {
 public:
  explicit LoopClosingThread(const LoopClosingOptions& options);

  /// Waits for the keyframe under way; those after it are left.
  ~LoopClosingThread();
  LoopClosingThread(const LoopClosingThread&) = delete;
  LoopClosingThread& operator=(const LoopClosingThread&) = delete;

  /// Is called on the thread after each keyframe. To be set before the first one.
  void after_keyframe(std::function<void(LoopCloser&)> call) { after_keyframe_ = std::move(call); }

  /// Hands over the next keyframe; returns at once.
  void add(Keyframe keyframe);

  /// Waits until all keyframes are worked off. The thread then leaves the closer alone until the next one is added.
  /// Throws what a keyframe threw.
  LoopCloser& closer();

  /// What the loops closed so far make of odometry's newest pose: T_map_lidar = T_map_odom * T_odom_lidar. The identity
  /// to the bit until something was optimised.
  Pose T_map_odom() const;

  /// T_map_lidar of the keyframes worked off so far; empty until something was optimised.
  std::vector<Pose> poses_so_far() const;
  bool has_corrected() const;  ///< whether something was optimised

  LoopTimes times() const;

 private:
  using Clock = std::chrono::steady_clock;

  struct Waiting {
    Keyframe keyframe;
    Clock::time_point since;
  };

  void work();
  LoopTimes close(Waiting waiting);

  LoopCloser closer_;  // the thread's while it is busy
  std::function<void(LoopCloser&)> after_keyframe_;
  mutable std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  std::deque<Waiting> waiting_;
  bool busy_ = false, ends_ = false;
  std::vector<Pose> poses_so_far_;
  Pose T_map_odom_ = Pose::Identity();
  LoopTimes times_;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace tilth
