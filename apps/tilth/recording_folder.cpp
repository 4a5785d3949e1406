#include "recording_folder.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "child_process.hpp"
#include <tilth/io/beam_file.hpp>
#include <tilth/io/output_file.hpp>
#include <tilth/io/trajectory_file.hpp>

namespace tilth::app {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kFormats{"pcd", "kitti", "bag", "pcap"};

/// As a shell takes it for one word, in quotes only where it needs them.
std::string shell_word(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_=,.:/+-";
  if (word.find_first_not_of(kPlain) == std::string::npos) return word;
  return quoted(word);
}

/// ASCII PLY: every vertex, every triangle with the number of its surface; the surfaces' names as comments.
std::string ply_of(const Mesh& mesh) {
  std::string text = "ply\nformat ascii 1.0\n";
  for (std::size_t i = 0; i < mesh.surfaces.size(); ++i) {
    text += "comment surface " + std::to_string(i) + " " + mesh.surfaces[i].name + "\n";
  }
  text += "element vertex " + std::to_string(mesh.vertices.size()) + "\n";
  text += "property float x\nproperty float y\nproperty float z\n";
  text += "element face " + std::to_string(mesh.triangles.size()) + "\n";
  text += "property list uchar int vertex_indices\nproperty ushort surface\nend_header\n";
  std::array<char, 96> line{};
  for (const Eigen::Vector3d& v : mesh.vertices) {
    std::snprintf(line.data(), line.size(), "%.6g %.6g %.6g\n", v.x(), v.y(), v.z());
    text += line.data();
  }
  for (const Triangle& t : mesh.triangles) {
    std::snprintf(line.data(), line.size(), "3 %u %u %u %u\n", t.vertices[0], t.vertices[1], t.vertices[2], t.surface);
    text += line.data();
  }
  return text;
}

}  // namespace

ScanFormat scan_format(std::string_view name) {
  const auto format = std::find(kFormats.begin(), kFormats.end(), name);
  if (format != kFormats.end()) return ScanFormat(format - kFormats.begin());
  throw Error("--format " + std::string(name), "is not known; there are pcd, kitti, bag, pcap");
}

RecordingFolder::RecordingFolder(const fs::path& folder, ScanFormat format, const LidarModel& lidar)
    : folder_(folder), format_(format) {
  make_folder(folder / "labels");
  make_folder(folder / "scene");
  if (format == ScanFormat::pcd) scans_ = scans_in_folder(folder, CloudFile::pcd);
  if (format == ScanFormat::kitti) scans_ = scans_in_folder(folder, CloudFile::kitti);
  if (format == ScanFormat::bag) scans_ = scans_in_bag(folder / "scans.bag");
  if (format == ScanFormat::pcap) packets_.emplace(folder / "scans.pcap", lidar);
}

void RecordingFolder::write(std::size_t index, const LabelledScan& labelled) {
  if (packets_)
    packets_->write(labelled.scan);
  else
    scans_.write(index, labelled.scan);
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%06zu.bin", index);
  OutputFile labels(folder_ / "labels" / name.data());
  labels.write(std::as_bytes(std::span(labelled.labels)));
  labels.close();
}

void RecordingFolder::close() {
  if (packets_)
    packets_->close();
  else
    scans_.close();
}

void RecordingFolder::write_truth(const Simulator& simulator) {
  std::vector<double> stamps;
  for (std::size_t i = 0; i < simulator.size(); ++i) stamps.push_back(simulator.stamp(i));
  write_times(folder_ / "times.txt", stamps);
  write_tum(folder_ / "truth.tum", simulator.truth());
  write_beams(folder_ / "beams.yaml", {simulator.beams(), {}});
  write_text(folder_ / "scene" / "mesh.ply", ply_of(simulator.world().mesh()));
}

void RecordingFolder::write_recipe(std::string_view scene, const SimulationOptions& options) {
  std::string text =
      "# tilth " TILTH_VERSION "; made again by:\ntilth simulate " + shell_word(std::string(scene)) + " --out DIR";
  text += " --format " + std::string(kFormats[std::size_t(format_)]);
  std::string table;
  for (const OptionInfo& row : describe(options)) {
    if (!row.value.empty()) text += " --set " + shell_word(row.key + "=" + row.value);
    table += row.key + " = " + row.value + "  # [" + row.unit + "] " + row.meaning + "\n";
  }
  write_text(folder_ / "recipe.txt", text + "\n\n# every option\n" + table);
}

}  // namespace tilth::app
