#include <algorithm>
#include <string_view>
#include <sys/resource.h>

#include <tilth/slam/loop_closing_thread.hpp>

namespace tilth {
namespace {

constexpr int kNiceness = 10;  ///< registration goes first where processors are scarce

double milliseconds_between(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b) {
  return std::chrono::duration<double, std::milli>(b - a).count();
}

/// The stage of `times` that the loop closer calls by this name.
double& stage_of(LoopTimes& times, std::string_view name) {
  if (name == "loop_detection") return times.detection_ms;
  return name == "loop_verification" ? times.verification_ms : times.graph_ms;
}

}  // namespace

LoopClosingThread::LoopClosingThread(const LoopClosingOptions& options)
    : closer_(options), thread_([this] { work(); }) {}

LoopClosingThread::~LoopClosingThread() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void LoopClosingThread::add(Keyframe keyframe) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({std::move(keyframe), Clock::now()});
  }
  changed_.notify_all();
}

LoopCloser& LoopClosingThread::closer() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.empty() && !busy_; });
  if (failure_) std::rethrow_exception(failure_);
  return closer_;
}

Pose LoopClosingThread::T_map_odom() const {
  const std::lock_guard lock(mutex_);
  return T_map_odom_;
}

std::vector<Pose> LoopClosingThread::poses_so_far() const {
  const std::lock_guard lock(mutex_);
  return poses_so_far_;
}

bool LoopClosingThread::has_corrected() const {
  const std::lock_guard lock(mutex_);
  return !poses_so_far_.empty();
}

LoopTimes LoopClosingThread::times() const {
  const std::lock_guard lock(mutex_);
  return times_;
}

void LoopClosingThread::work() {
  setpriority(PRIO_PROCESS, 0, kNiceness);  // on Linux, of this thread alone
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
    if (ends_) return;
    Waiting next = std::move(waiting_.front());
    waiting_.pop_front();
    busy_ = true;
    lock.unlock();
    LoopTimes spent;
    std::exception_ptr failure;
    try {
      spent = close(std::move(next));
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    busy_ = false;
    if (failure) failure_ = failure;
    times_.detection_ms += spent.detection_ms, times_.verification_ms += spent.verification_ms;
    times_.graph_ms += spent.graph_ms;
    times_.longest_wait_ms = std::max(times_.longest_wait_ms, spent.longest_wait_ms);
    if (closer_.optimizations() > 0) {
      poses_so_far_ = closer_.poses();
      T_map_odom_ = normalized(closer_.poses().back() * closer_.keyframes().back().T_odometry_lidar.inverse());
    }
    changed_.notify_all();
  }
}

LoopTimes LoopClosingThread::close(Waiting waiting) {
  LoopTimes spent;
  double* stage = nullptr;
  Clock::time_point since = Clock::now();
  const auto end_stage = [&] {
    const Clock::time_point now = Clock::now();
    if (stage != nullptr) *stage += milliseconds_between(since, now);
    since = now;
  };
  closer_.add(std::move(waiting.keyframe), [&](std::string_view name) {
    end_stage();
    stage = &stage_of(spent, name);
  });
  if (after_keyframe_) after_keyframe_(closer_);
  end_stage();
  spent.longest_wait_ms = milliseconds_between(waiting.since, since);
  return spent;
}

}  // namespace tilth
