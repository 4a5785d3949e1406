// The folder of a simulated recording: scans, times.txt, truth.tum, labels, the scene's mesh and how to make it again.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <tilth/simulation/simulator.hpp>

namespace tilth::app {

enum class ScanFormat { pcd, kitti };

/// Throws Error listing the formats.
ScanFormat scan_format(std::string_view name);

class RecordingFolder {
 public:
  /// Makes the folder and those in it. Throws Error where that fails.
  RecordingFolder(const std::filesystem::path& folder, ScanFormat format);

  void write(std::size_t index, const LabelledScan& labelled);  ///< scan and labels; may be called from several threads
  void write_truth(const Simulator& simulator);                 ///< times.txt, truth.tum, scene/mesh.ply
  void write_recipe(std::string_view scene, const SimulationOptions& options);

 private:
  std::filesystem::path folder_;
  ScanFormat format_;
};

}  // namespace tilth::app
