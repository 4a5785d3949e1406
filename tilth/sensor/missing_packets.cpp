#include <cmath>

#include <tilth/sensor/missing_packets.hpp>
#include <tilth/sensor/packet.hpp>

namespace tilth {
namespace {

constexpr double kSameAzimuth = 600.0;  // [0.01 deg] a packet covers up to 5 deg
constexpr double kSamePackets = 3.0;
constexpr std::size_t kFewest = 3;  ///< packets of a view's gap: shorter ones are losses

}  // namespace

void MissingPackets::add(double azimuth, std::size_t packets) {
  if (packets < kFewest) {
    lost_ += packets;
    return;
  }
  Gap gap{azimuth, packets, false};
  if (last_ && std::abs(std::remainder(azimuth - last_->azimuth, kAzimuthsATurn)) < kSameAzimuth &&
      std::abs(double(packets) - double(last_->packets)) <= kSamePackets) {
    gap.unsent = true;
    if (!last_->unsent) {
      lost_ -= last_->packets;
      unsent_ += last_->packets;
    }
  }
  (gap.unsent ? unsent_ : lost_) += packets;
  last_ = gap;
}

}  // namespace tilth
