#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <nlohmann/json.hpp>

#include <tilth/core/error.hpp>
#include <tilth/sensor/ouster_metadata.hpp>

namespace tilth {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegree = std::numbers::pi / 180.0, kMillimetre = 1e-3;
constexpr std::size_t kMostRows = 256, kMostColumns = 4096;
constexpr std::array<std::string_view, 4> kProfiles{"LEGACY", "RNG19_RFL8_SIG16_NIR16", "RNG19_RFL8_SIG16_NIR16_DUAL",
                                                    "RNG15_RFL8_NIR8"};
constexpr std::array kSections{"beam_intrinsics", "lidar_intrinsics", "lidar_data_format",
                               "data_format",     "config_params",    "sensor_info"};

/// Finds keys at the top, as old firmware writes them, or in a section.
class MetadataReader {
 public:
  MetadataReader(const Json& root, const std::string& name) : root_(root), name_(name) {}

  const Json* find(const char* key) const {
    if (const auto at = root_.find(key); at != root_.end()) return &*at;
    for (const char* section : kSections) {
      const auto inner = root_.find(section);
      if (inner == root_.end() || !inner->is_object()) continue;
      if (const auto at = inner->find(key); at != inner->end()) return &*at;
    }
    return nullptr;
  }

  std::string text(const char* key) const {
    const Json* value = find(key);
    if (value == nullptr) return "";
    return value->is_string() ? value->get<std::string>() : value->dump();
  }

  /// A count from 1 to `most`; `otherwise` where the key is missing.
  std::size_t count(const char* key, std::size_t otherwise, std::size_t most) const {
    const Json* value = find(key);
    if (value == nullptr) return otherwise;
    if (!value->is_number_unsigned() || value->get<std::uint64_t>() < 1 || value->get<std::uint64_t>() > most)
      throw Error(name_, "key " + std::string(key) + " is no number from 1 to " + std::to_string(most));
    return value->get<std::size_t>();
  }

  /// Finite numbers; none where the key is missing. Rows of lists are joined.
  std::vector<double> numbers(const char* key) const {
    std::vector<double> all;
    if (const Json* value = find(key)) append(*value, key, 2, all);
    return all;
  }

  [[noreturn]] void refuse(const std::string& what) const { throw Error(name_, what); }

 private:
  void append(const Json& value, const char* key, int depth, std::vector<double>& all) const {
    if (value.is_array() && depth > 0 && all.size() <= kMostRows) {
      for (const Json& each : value) append(each, key, depth - 1, all);
      return;
    }
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (!std::isfinite(number)) refuse("key " + std::string(key) + " is no list of numbers");
    all.push_back(number);
  }

  const Json& root_;
  const std::string& name_;
};

Json parsed(std::string_view text, const std::string& name) {
  constexpr std::size_t kMostBytes = 4 << 20;
  if (text.size() > kMostBytes) throw Error(name, "is too long to be the metadata of an Ouster sensor");
  Json root = Json::parse(text, nullptr, false);
  if (!root.is_object()) throw Error(name, "is no JSON object, as the metadata of an Ouster sensor is");
  return root;
}

std::vector<double> angles(const MetadataReader& read, const char* key) {
  std::vector<double> all = read.numbers(key);
  if (all.empty() || all.size() > kMostRows) read.refuse("key " + std::string(key) + " is missing or empty");
  for (double& angle : all) angle *= kDegree;
  return all;
}

/// "1024x10": columns a turn and turns a second.
void read_mode(const MetadataReader& read, OusterMetadata& metadata) {
  const std::string mode = read.text("lidar_mode");
  unsigned columns = 0, rate = 0;
  if (std::sscanf(mode.c_str(), "%4ux%3u", &columns, &rate) != 2 || columns < 1 || columns > kMostColumns || rate < 1)
    read.refuse("key lidar_mode is \"" + mode + "\", expected columns and turns a second, as 1024x10");
  metadata.columns = columns, metadata.rate = rate;
}

OusterProfile profile_of(const MetadataReader& read) {
  const std::string name = read.find("udp_profile_lidar") == nullptr ? "LEGACY" : read.text("udp_profile_lidar");
  const auto found = std::find(kProfiles.begin(), kProfiles.end(), name);
  if (found != kProfiles.end()) return OusterProfile(found - kProfiles.begin());
  std::string known;
  for (const std::string_view each : kProfiles) known += (known.empty() ? "" : ", ") + std::string(each);
  read.refuse("packets of profile " + name + " are not known; there are " + known);
}

void read_window(const MetadataReader& read, OusterMetadata& metadata) {
  metadata.window_begin = 0, metadata.window_end = metadata.columns - 1;
  const std::vector<double> window = read.numbers("column_window");
  if (window.empty()) return;
  const auto fits = [&](double at) { return at >= 0.0 && at < double(metadata.columns) && at == std::floor(at); };
  if (window.size() != 2 || !fits(window[0]) || !fits(window[1]))
    read.refuse("key column_window is no pair of columns below " + std::to_string(metadata.columns));
  metadata.window_begin = std::size_t(window[0]), metadata.window_end = std::size_t(window[1]);
}

/// [m] of a product whose firmware did not tell it yet (ouster-sdk, default_lidar_origin_to_beam_origin).
double usual_beam_origin(const MetadataReader& read, const std::string& product) {
  if (product.starts_with("OS-0-")) return 0.02767;
  if (product.starts_with("OS-1-")) return 0.0158060;
  if (product.starts_with("OS-2-")) return 0.0137620;
  read.refuse("has neither beam_to_lidar_transform nor lidar_origin_to_beam_origin_mm");
}

void read_geometry(const MetadataReader& read, OusterMetadata& metadata) {
  const std::vector<double> beam = read.numbers("beam_to_lidar_transform");
  const std::vector<double> origin = read.numbers("lidar_origin_to_beam_origin_mm");
  if (beam.size() == 16)
    metadata.beam_origin = Eigen::Vector3d(beam[3], 0.0, beam[11]) * kMillimetre;
  else
    metadata.beam_origin.x() = origin.empty() ? usual_beam_origin(read, metadata.product) : origin[0] * kMillimetre;
  metadata.T_sensor_lidar.linear() = Eigen::Vector3d(-1, -1, 1).asDiagonal();
  metadata.T_sensor_lidar.translation() = Eigen::Vector3d(0, 0, 0.03618);
  const std::vector<double> sensor = read.numbers("lidar_to_sensor_transform");
  if (sensor.size() != 16) return;
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> given(sensor.data());
  metadata.T_sensor_lidar.linear() = given.topLeftCorner<3, 3>();
  metadata.T_sensor_lidar.translation() = given.topRightCorner<3, 1>() * kMillimetre;
}

}  // namespace

bool OusterMetadata::in_window(std::size_t measurement) const {
  if (window_begin <= window_end) return measurement >= window_begin && measurement <= window_end;
  return measurement < columns && (measurement >= window_begin || measurement <= window_end);
}

std::size_t OusterMetadata::window_size() const {
  return window_begin <= window_end ? window_end - window_begin + 1 : columns - window_begin + window_end + 1;
}

OusterMetadata parse_ouster_metadata(std::string_view text, const std::string& name) {
  const Json root = parsed(text, name);
  const MetadataReader read(root, name);
  OusterMetadata metadata;
  metadata.product = read.text("prod_line"), metadata.serial = read.text("prod_sn");
  metadata.firmware = read.text("build_rev");
  if (const Json* start = read.find("initialization_id"); start != nullptr && start->is_number_unsigned())
    metadata.start = std::uint32_t(start->get<std::uint64_t>() & 0xFFFFFF);
  metadata.altitudes = angles(read, "beam_altitude_angles");
  metadata.azimuths = angles(read, "beam_azimuth_angles");
  if (metadata.azimuths.size() != metadata.altitudes.size() ||
      read.count("pixels_per_column", metadata.rows(), kMostRows) != metadata.rows())
    read.refuse("beam_altitude_angles, beam_azimuth_angles and pixels_per_column differ in number");
  read_mode(read, metadata);
  if (read.count("columns_per_frame", metadata.columns, kMostColumns) != metadata.columns)
    read.refuse("columns_per_frame and lidar_mode contradict one another");
  metadata.columns_a_packet = read.count("columns_per_packet", 16, 64);
  metadata.profile = profile_of(read);
  read_window(read, metadata);
  read_geometry(read, metadata);
  return metadata;
}

std::string_view name_of(OusterProfile profile) {
  return kProfiles[std::size_t(profile)];
}

}  // namespace tilth
