// A packet that a simulated sensor sends.
#pragma once

#include <cstddef>
#include <vector>

namespace tilth {

struct EncodedPacket {
  double sent = 0.0;  ///< [s] after the last shot
  std::vector<std::byte> payload;
};

}  // namespace tilth
