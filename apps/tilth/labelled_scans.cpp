#include "labelled_scans.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include <tilth/core/error.hpp>
#include <tilth/core/parallel.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/simulation/simulator.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth::app {
namespace {

namespace fs = std::filesystem;

fs::path label_file(const fs::path& folder, std::size_t index) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%06zu.bin", index);
  return folder / "labels" / name.data();
}

std::vector<std::uint8_t> read_labels(const fs::path& path, std::size_t points) {
  const std::vector<std::byte> bytes = read_file(path);
  if (bytes.size() != points) {
    throw Error(path.string(), "has " + std::to_string(bytes.size()) + " labels, but the scan " +
                                   std::to_string(points) + " points; one byte a point is expected");
  }
  std::vector<std::uint8_t> labels(points);
  if (points > 0) std::memcpy(labels.data(), bytes.data(), points);
  return labels;
}

std::vector<LabelledCloud> from_folder(const LabelledSource& from) {
  const fs::path folder = from.name, bag = folder / "scans.bag";
  if (!fs::is_directory(folder / "labels")) {
    throw Error((folder / "labels").string(), "no such folder; recordings of `tilth simulate` have labels");
  }
  const std::unique_ptr<ScanSource> source = open_source((fs::exists(bag) ? bag : folder).string(), {});
  std::vector<LabelledCloud> scans;
  for (std::size_t index = 0;; ++index) {
    std::optional<Scan> scan = source->next();
    if (!source->skipped().empty()) throw Error(source->skipped()[0].where, source->skipped()[0].what);
    if (!scan) return scans;
    if (index % from.every != 0) continue;
    std::vector<std::uint8_t> labels = read_labels(label_file(folder, index), scan->cloud.size());
    scans.push_back({std::move(scan->cloud), std::move(labels), {}});
  }
}

std::vector<LabelledCloud> from_scene(const LabelledSource& from) {
  const Simulator simulator(from.name, simulation_options(from.name, from.simulation));
  std::vector<LabelledCloud> scans((simulator.size() + from.every - 1) / from.every);
  parallel_for(scans.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      LabelledScan made = simulator.scan(i * from.every);
      scans[i] = {std::move(made.scan.cloud), std::move(made.labels), {}};
    }
  });
  return scans;
}

}  // namespace

std::vector<LabelledCloud> labelled_scans(const LabelledSource& source) {
  const auto scenes = scene_names();
  const bool is_scene = std::find(scenes.begin(), scenes.end(), source.name) != scenes.end();
  const bool is_path = !is_scene && (fs::exists(source.name) || source.name.find('/') != std::string::npos);
  if (is_path && !fs::is_directory(source.name)) throw Error(source.name, "no such folder");
  if (is_path && !source.simulation.empty()) {
    throw Error("--" + source.simulation.begin()->first, "is for scenes; " + source.name + " is a recording");
  }
  std::vector<LabelledCloud> scans = is_path ? from_folder(source) : from_scene(source);
  if (scans.empty()) throw Error(source.name, "has no scan");
  parallel_for(scans.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) scans[i].obvious = mark_obvious(scans[i].cloud, scans[i].labels);
  });
  return scans;
}

}  // namespace tilth::app
