#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>

#include "number_list.hpp"
#include "run_matrix.hpp"
#include <tilth/core/error.hpp>
#include <tilth/simulation/scenes.hpp>
#include <tilth/simulation/simulator.hpp>
#include <tilth/sources/simulated_source.hpp>
#include <tilth/sources/source_uri.hpp>

namespace tilth::app {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 6> kTruthNames{"truth.tum",       "truth.txt",        "groundtruth.tum",
                                                 "groundtruth.txt", "ground_truth.txt", "poses.txt"};

std::string short_hash(const std::string& text) {
  std::uint32_t hash = 2166136261U;  // FNV-1a
  for (const char c : text) hash = (hash ^ std::uint8_t(c)) * 16777619U;
  std::array<char, 16> digits{};
  std::snprintf(digits.data(), digits.size(), "-%08x", hash);
  return digits.data();
}

/// The truth beside a recording: --truth there or as it stands, else the first of the usual names.
fs::path truth_of(const fs::path& recording, const std::string& asked) {
  const fs::path folder = fs::is_directory(recording) ? recording : recording.parent_path();
  if (!asked.empty()) {
    if (fs::is_regular_file(folder / asked)) return folder / asked;
    if (fs::is_regular_file(asked)) return fs::absolute(asked);
    throw Error("--truth " + asked, "is neither in " + folder.string() + " nor a file");
  }
  std::string names;
  for (const char* name : kTruthNames) {
    if (fs::is_regular_file(folder / name)) return folder / name;
    names += std::string(names.empty() ? "" : ", ") + name;
  }
  throw Error(recording.string(), "has no truth beside it (" + names + "); name it with --truth");
}

MatrixSource simulated(const std::string& uri, const std::string& seed, const fs::path& out) {
  const std::string label = uri.substr(kSimulatedScheme.size());
  SourceUri source = parse_source_uri(label);
  const auto own = source.values.find("seed");
  if (own == source.values.end()) source.values["seed"] = seed;
  const std::string used = source.values["seed"];
  const fs::path folder = out / "recordings" / folder_name(own == source.values.end() ? label + "-" + used : label);
  Command make{"tilth", "simulate", source.what, "--out", folder.string(), "--quiet"};
  for (const auto& [key, value] : source.values) make.insert(make.end(), {"--set", key + "=" + value});
  return {label, used, {folder, make, own_name()}, folder / "truth.tum"};
}

MatrixSource recorded(const std::string& uri, const std::string& truth) {
  const std::string path = parse_path_uri(uri).what;
  if (!fs::exists(path)) throw Error("--sources " + uri, "is no file, no folder and no sim://SCENE");
  const fs::path absolute = fs::weakly_canonical(path);
  const fs::path found = truth_of(absolute, truth);
  const std::string query = uri.substr(path.size());
  return {absolute.filename().string() + query, "", {absolute, {}, ""}, found, query};
}

std::vector<std::string> names_of_sources(const MatrixArguments& arguments) {
  std::vector<std::string> names;
  for (const std::string& list : arguments.source_lists) {
    for (std::string& name : parse_word_list("--sources", list)) names.push_back(std::move(name));
  }
  names.insert(names.end(), arguments.single_sources.begin(), arguments.single_sources.end());
  if (names.empty()) throw Error("--sources", "is missing: expected sim://SCENE or recordings with truth");
  return names;
}

/// Scenes and keys are checked before hours of work depend on them; world files when they are read.
void check_scene(const std::string& uri) {
  const SourceUri source = parse_source_uri(uri.substr(kSimulatedScheme.size()));
  const auto scenes = scene_names();
  const bool built_in = std::find(scenes.begin(), scenes.end(), source.what) != scenes.end();
  if (!built_in && !fs::exists(source.what))
    throw Error("--sources " + uri, "is no scene; there are " + options_detail::joined(scenes));
  simulation_options(built_in ? std::string_view(source.what) : kForeignScene, source.values);
}

void refuse_twins(const std::vector<MatrixSource>& sources) {
  for (std::size_t i = 0; i < sources.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (sources[i].label != sources[j].label || sources[i].seed != sources[j].seed) continue;
      throw Error("--sources", "names " + sources[i].label + " twice; recordings need folders of different names");
    }
  }
}

}  // namespace

std::string folder_name(const std::string& label) {
  std::string name;
  for (const char c : label) {
    const bool plain =
        std::isalnum(static_cast<unsigned char>(c)) || std::string("_.=:,+-").find(c) != std::string::npos;
    name += plain ? c : c == '?' ? ':' : c == '&' ? ',' : '_';
  }
  constexpr std::size_t kLongest = 120;
  const bool changed = std::count(name.begin(), name.end(), '_') != std::count(label.begin(), label.end(), '_');
  if (!changed && name.size() <= kLongest && !name.starts_with('.')) return name;
  return std::string("_").append(name, 0, kLongest).append(short_hash(label));
}

std::vector<MatrixSource> matrix_sources(const MatrixArguments& arguments) {
  const std::vector<std::uint64_t> seeds = parse_number_list("--seeds", arguments.seeds);
  const fs::path out = fs::absolute(arguments.out).lexically_normal();
  std::vector<MatrixSource> sources;
  for (const std::string& name : names_of_sources(arguments)) {
    if (!name.starts_with(kSimulatedScheme)) {
      sources.push_back(recorded(name, arguments.truth));
      continue;
    }
    check_scene(name);
    const bool own_seed = parse_source_uri(name).values.contains("seed");
    for (const std::uint64_t seed : seeds) {
      sources.push_back(simulated(name, std::to_string(seed), out));
      if (own_seed) break;
    }
  }
  refuse_twins(sources);
  return sources;
}

}  // namespace tilth::app
