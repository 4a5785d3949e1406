#include <string_view>
#include <vector>

#include <tilth/core/error.hpp>
#include <tilth/io/input_file.hpp>
#include <tilth/sources/sensor_files.hpp>

namespace tilth {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMostBytes = 4 << 20;

bool tells_beams(const fs::path& path) {
  std::error_code error;
  if (path.extension() != ".json" || !fs::is_regular_file(path, error) || fs::file_size(path, error) > kMostBytes)
    return false;
  return as_text(read_file(path)).find("beam_altitude_angles") != std::string_view::npos;
}

}  // namespace

SensorFile read_sensor_file(const fs::path& path) {
  if (!fs::is_regular_file(path)) throw Error(path.string(), "is no file");
  if (fs::file_size(path) > kMostBytes) throw Error(path.string(), "is too long to be about a sensor");
  return parse_sensor_file(as_text(read_file(path)), path.string());
}

fs::path ouster_metadata_beside(const fs::path& recording) {
  fs::path same = recording;
  same.replace_extension(".json");
  if (tells_beams(same)) return same;
  std::vector<fs::path> found;
  const fs::path folder = recording.has_parent_path() ? recording.parent_path() : fs::path(".");
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (tells_beams(entry.path())) found.push_back(entry.path());
  }
  return found.size() == 1 ? found.front() : fs::path{};
}

}  // namespace tilth
