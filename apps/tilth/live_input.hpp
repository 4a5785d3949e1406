// What `tilth live` listens to: packets of a sensor, or clouds of a topic of ROS 2.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "console.hpp"
#include <tilth/core/options.hpp>
#include <tilth/run/stopwatch.hpp>
#include <tilth/sources/live_scans.hpp>

namespace CLI {
class App;
}

namespace tilth::app {

/// The flags of both.
void add_live_flags(CLI::App& command, OptionValues& values);

using Enough = std::function<bool()>;

/// Listens and waits for the sensor, until it is enough; nothing where that was interrupted. Throws Error where the
/// source is not understood or cannot be listened to, and where it is enough before a scan came.
std::unique_ptr<LiveScans> open_live(const std::string& source, const OptionValues& values, const Enough& enough,
                                     Console& console);

/// Shows the run, and what of the sensor's data is lost.
class LiveConsole final : public RunObserver {
 public:
  LiveConsole(const LiveScans& source, Console& console) : source_(source), console_(console) {}

  void note(const std::string& text) override { console_.note(text); }
  void warn(const std::string& text) override { console_.warn(text); }
  void progress(std::size_t scans, std::optional<std::size_t> total) override;

 private:
  const LiveScans& source_;
  Console& console_;
  Stopwatch telling_;
  std::size_t told_ = 0;
};

}  // namespace tilth::app
