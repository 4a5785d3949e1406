// run.mcap: a run as ROS 2 messages, as Foxglove and `ros2 bag play` take them. Clouds of scans are written while the
// run goes on, poses and map at its end. About 1 ms a scan of 5,000 points.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <tilth/run/run_messages.hpp>
#include <tilth/run/sink.hpp>

namespace tilth {

class McapWriter;

class McapSink final : public Sink {
 public:
  /// `points` of a scan are written at most; 0: scans are not. Throws Error where the file cannot be made.
  McapSink(const std::filesystem::path& path, std::uint64_t points);
  ~McapSink() override;
  McapSink(const McapSink&) = delete;
  McapSink& operator=(const McapSink&) = delete;

  /// The scan. What fails is kept for finish().
  void take(const Scan& scan, const OdometryResult& result, const RunRecord& record) override;

  /// Odometry, transform and diagnostics of each pose, path, map; only then does the file stand under its name. Throws
  /// Error where it cannot be written in full.
  void finish(const RunRecord& record) override;

 private:
  void write(RunTopic topic, double stamp, const std::vector<std::byte>& message);

  std::unique_ptr<McapWriter> file_;
  std::uint64_t points_;
  std::vector<std::uint32_t> topics_;  // by RunTopic
  std::string problem_;
};

}  // namespace tilth
