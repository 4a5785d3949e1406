#include <algorithm>
#include <utility>

#include <tilth/core/error.hpp>
#include <tilth/sources/live_scans.hpp>
#include <tilth/sources/ros2_library.hpp>
#include <tilth/sources/ros2_topic.hpp>
#include <tilth/sources/source_uri.hpp>

namespace tilth {
namespace {

constexpr int kBetweenQuestions = 100;   // [ms]
constexpr std::size_t kLeastDepth = 10;  // of clouds that came at once

std::uint64_t nanoseconds_now() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::uint64_t(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
}

}  // namespace

Ros2Address parse_ros2_uri(const std::string& uri, const OptionValues& values) {
  if (!uri.starts_with(kRos2Scheme)) throw Error(uri, "is no topic of ROS 2: expected ros2:TOPIC, as ros2:/points");
  SourceUri source = parse_source_uri(uri.substr(kRos2Scheme.size()));
  if (source.what.empty()) throw Error(uri, "names no topic: expected ros2:TOPIC, as ros2:/points");
  source.values.insert(values.begin(), values.end());
  return {source.what, options_of<Ros2Options>("a topic of ROS 2", source.values)};
}

Ros2Topic::Ros2Topic(const TilthRos2Library& library, Ros2Address address, std::function<bool()> stopped)
    : library_(library),
      address_(std::move(address)),
      stopped_(std::move(stopped)),
      clouds_(std::make_shared<CloudInbox>(address_.options.queue)),
      thread_([this](const std::stop_token& token) { receive(token); }) {}

Ros2Topic::~Ros2Topic() {
  stop();
}

void Ros2Topic::stop() {
  thread_.request_stop();
  clouds_->close();
}

void Ros2Topic::receive(const std::stop_token& token) {
  using Clock = std::chrono::steady_clock;
  const Ros2Options& options = address_.options;
  TilthRos2Topic* const topic =
      library_.open(address_.topic.c_str(), options.reliable, std::max(kLeastDepth, std::size_t(options.queue)));
  Clock::time_point last = Clock::now();  // a cloud came
  const auto goes_on = [&] {
    const double silent = std::chrono::duration<double>(Clock::now() - last).count();
    return !token.stop_requested() && !clouds_->ended() && !(stopped_ && stopped_()) &&
           !(options.idle > 0.0 && silent > options.idle);
  };
  while (goes_on())
    if (take(topic)) last = Clock::now();
  library_.close(topic);
  clouds_->end();
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

/// Whether a cloud came.
bool Ros2Topic::take(TilthRos2Topic* topic) {
  TilthRos2Cloud cloud{};
  const int came = library_.next(topic, kBetweenQuestions, &cloud);
  if (came < 0) fail(library_.text(topic));
  if (came > 0) {
    const auto* begin = reinterpret_cast<const std::byte*>(cloud.bytes);
    clouds_->lose(cloud.lost);
    clouds_->push({0, nanoseconds_now(), {begin, begin + cloud.size}});
  }
  const std::lock_guard lock(mutex_);
  if (came == 0 && !begun_) situation_ = library_.text(topic);
  if (came > 0 && !std::exchange(begun_, true)) changed_.notify_all();
  return came > 0;
}

bool Ros2Topic::wait_for_first(std::chrono::milliseconds longest) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, longest, [&] { return begun_ || ended_; });
}

std::string Ros2Topic::situation() const {
  const std::lock_guard lock(mutex_);
  return situation_;
}

std::string Ros2Topic::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_;
}

void Ros2Topic::fail(const std::string& problem) {
  const std::lock_guard lock(mutex_);
  problem_ = problem;
  clouds_->end();
}

std::unique_ptr<Ros2Topic> listen(const Ros2Address& address, std::function<bool()> stopped) {
  return std::make_unique<Ros2Topic>(load_ros2_library(address.options.library), address, std::move(stopped));
}

}  // namespace tilth
