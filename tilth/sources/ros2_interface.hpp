// What libtilth_ros2 (ros2/) gives to a program that loads it while it runs: the clouds of one topic. In C, so that
// they may be made by different compilers. Nothing here throws.
#pragma once

#include <cstddef>

extern "C" {

struct TilthRos2Topic;  ///< the library's own

struct TilthRos2Cloud {
  const unsigned char* bytes;  ///< sensor_msgs/PointCloud2 as CDR, until the next call
  std::size_t size;
  std::size_t lost;  ///< clouds before it that never came, as far as the middleware knows
};

struct TilthRos2Library {
  /// From now on clouds are kept by the middleware, `depth` of them. Not null, also where that failed: next() says so.
  TilthRos2Topic* (*open)(const char* topic, bool reliable, std::size_t depth);

  /// Waits so long for a cloud: 1 where one came, 0 where none did, -1 where something is wrong.
  int (*next)(TilthRos2Topic*, int milliseconds, TilthRos2Cloud*);

  /// After -1 what is wrong, else who sends the topic: a sentence, until the next call.
  const char* (*text)(TilthRos2Topic*);

  void (*close)(TilthRos2Topic*);
};

/// The library's only symbol; its number changes with what is above.
const TilthRos2Library* tilth_ros2_library_1();

}  // extern "C"

namespace tilth {

inline constexpr const char* kRos2Entry = "tilth_ros2_library_1";

}  // namespace tilth
