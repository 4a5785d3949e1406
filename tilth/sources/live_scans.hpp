// Scans of a sensor while it sends, of which some may be lost.
#pragma once

#include <cstddef>
#include <string>

#include <tilth/sources/scan_source.hpp>

namespace tilth {

inline const std::string kLiveScheme = "udp://";  ///< packets: [ADDRESS]:PORT follows
inline const std::string kRos2Scheme = "ros2:";   ///< clouds: a topic of ROS 2 follows

/// Whether a name stands for a sensor that is waited for; open_source() takes both.
inline bool is_live(const std::string& uri) {
  return uri.starts_with(kLiveScheme) || uri.starts_with(kRos2Scheme);
}

class LiveScans : public ScanSource {
 public:
  struct Losses {
    std::size_t count = 0;
    std::string sentence;  ///< of what and why; empty where nothing is lost
  };
  virtual Losses losses() const = 0;
};

}  // namespace tilth
