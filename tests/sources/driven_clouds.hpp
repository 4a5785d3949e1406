// Clouds of a simulated drive, as a driver sends them.
#pragma once

#include <string>
#include <vector>

#include <tilth/io/cloud_records.hpp>
#include <tilth/io/recording.hpp>
#include <tilth/messages/point_cloud2.hpp>
#include <tilth/sources/open_source.hpp>

namespace tilth {

/// Of the frame "velodyne"; those stamped before `begin` [s] are left out.
inline std::vector<Message> driven_clouds(const std::string& scene, double begin,
                                          Serialization serialization = Serialization::cdr) {
  std::vector<Message> messages;
  const auto source = open_source(scene, {});
  while (const std::optional<Scan> scan = source->next()) {
    if (scan->stamp < begin) continue;
    messages.push_back({0, std::uint64_t((scan->stamp + 0.1) * 1e9),
                        serialize_point_cloud2({scan->stamp, "velodyne", to_records(scan->cloud)}, serialization)});
  }
  return messages;
}

}  // namespace tilth
