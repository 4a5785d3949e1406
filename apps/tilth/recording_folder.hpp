// The folder of a simulated recording: scans (or one bag or network capture), times.txt, truth.tum, beams.yaml, labels,
// the scene's mesh and how to make it again.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "packet_recording.hpp"
#include "scan_writer.hpp"
#include <tilth/simulation/simulator.hpp>

namespace tilth::app {

enum class ScanFormat { pcd, kitti, bag, pcap };

/// Throws Error listing the formats.
ScanFormat scan_format(std::string_view name);

class RecordingFolder {
 public:
  /// Makes the folder and those in it. Throws Error where that fails, or `lidar` has no packets for pcap.
  RecordingFolder(const std::filesystem::path& folder, ScanFormat format, const LidarModel& lidar);

  /// One scan and its labels, in the order of their indices.
  void write(std::size_t index, const LabelledScan& labelled);
  void write_truth(const Simulator& simulator);  ///< times.txt, truth.tum, beams.yaml, scene/mesh.ply
  void write_recipe(std::string_view scene, const SimulationOptions& options);
  void close();  ///< only then does a bag or capture stand under its name

 private:
  std::filesystem::path folder_;
  ScanFormat format_;
  ScanWriter scans_;                        // unless they are packets
  std::optional<PacketRecording> packets_;  // of pcap
};

}  // namespace tilth::app
