#include "live_input.hpp"

#include <algorithm>
#include <chrono>

#include <CLI/CLI.hpp>

#include "interrupt.hpp"
#include "option_flags.hpp"
#include <tilth/core/error.hpp>
#include <tilth/sources/live_source.hpp>
#include <tilth/sources/ros2_source.hpp>

namespace tilth::app {
namespace {

std::unique_ptr<LiveScans> open_packets_of(const LiveAddress& address, const Enough& stopped, Console& console) {
  std::unique_ptr<PacketReceiver> receiver = listen(address, stopped);
  console.note("listening at " + receiver->name() + "; Ctrl-C ends it");
  if (!receiver->warning().empty()) console.warn(receiver->warning());
  return std::make_unique<LiveSource>(std::move(receiver), address.options);
}

/// Says what it waits for, as often as that changes.
void wait_for_clouds(Ros2Topic& topic, Console& console) {
  constexpr std::chrono::seconds kPatience(2);
  std::string said;
  while (!topic.wait_for_first(kPatience)) {
    const std::string situation = topic.situation();
    if (situation != said) console.note("waits for clouds of " + topic.name() + ": " + situation);
    said = situation;
  }
}

std::unique_ptr<LiveScans> open_topic(const Ros2Address& address, const Enough& stopped, Console& console) {
  std::unique_ptr<Ros2Topic> topic = listen(address, stopped);
  console.note("listening to the topic " + topic->name() + "; Ctrl-C ends it");
  wait_for_clouds(*topic, console);
  return std::make_unique<Ros2Source>(std::move(topic));
}

}  // namespace

void add_live_flags(CLI::App& command, OptionValues& values) {
  std::vector<OptionInfo> flags = describe(LiveOptions{});
  for (OptionInfo& option : describe(Ros2Options{})) {
    const auto is_it = [&](const OptionInfo& known) { return known.key == option.key; };
    if (std::none_of(flags.begin(), flags.end(), is_it)) flags.push_back(std::move(option));
  }
  add_option_flags(command, flags, values);
}

std::unique_ptr<LiveScans> open_live(const std::string& source, const OptionValues& values, const Enough& enough,
                                     Console& console) {
  const Enough stopped = [enough] { return interrupted() != 0 || enough(); };
  const bool is_topic = source.starts_with(kRos2Scheme);
  if (!is_topic && !source.starts_with(kLiveScheme))
    throw Error(source, "is no live source: expected udp://[ADDRESS]:PORT or ros2:TOPIC");
  try {
    return is_topic ? open_topic(parse_ros2_uri(source, values), stopped, console)
                    : open_packets_of(parse_live_uri(source, values), stopped, console);
  } catch (const Error&) {
    if (interrupted() == 0) throw;
    return nullptr;
  }
}

void LiveConsole::progress(std::size_t scans, std::optional<std::size_t> total) {
  constexpr double kSecondsBetweenTellings = 1.0;
  const LiveScans::Losses losses = source_.losses();
  if (losses.count != told_ && telling_.seconds() >= kSecondsBetweenTellings) {
    told_ = losses.count;
    telling_ = Stopwatch();
    console_.warn(losses.sentence);
  }
  console_.progress(scans, total);
}

}  // namespace tilth::app
