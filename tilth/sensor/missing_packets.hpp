// Packets that did not come: lost on the way, or never sent because the sensor's view is cropped to a part of the turn.
#pragma once

#include <cstddef>
#include <optional>

namespace tilth {

class MissingPackets {
 public:
  /// `packets` are missing after a column at `azimuth` [0.01 deg].
  void add(double azimuth, std::size_t packets);

  std::size_t lost() const { return lost_; }
  std::size_t unsent() const { return unsent_; }  ///< about as many, after about the same azimuth, as the time before

 private:
  struct Gap {
    double azimuth = 0.0;
    std::size_t packets = 0;
    bool unsent = false;
  };

  std::optional<Gap> last_;
  std::size_t lost_ = 0, unsent_ = 0;
};

}  // namespace tilth
