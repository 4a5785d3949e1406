// How the clock in a sensor's packets counts: from the hour, the second, or 1970, in micro- or nanoseconds.
#pragma once

#include <optional>
#include <span>

#include <tilth/sensor/packet.hpp>
#include <tilth/sensor/packet_clock.hpp>

namespace tilth {

constexpr double kEarliestClock = 1420070400.0;  ///< [s] the year 2015: a clock before that was never set
constexpr double kLatestClock = 7258118400.0;    ///< [s] the year 2200: nor was one after that

struct ClockConvention {
  double fraction_unit = 1e-6;  ///< [s] of the fraction in dated packets
  ClockTraits traits;
};

/// From the first data packets, of which there must be one.
ClockConvention decide_clock(std::span<const DataPacket> first, const PacketFormat& format,
                             const std::optional<ClockTraits::Mark>& mark);

ClockReading read_clock(const DataPacket& packet, const std::optional<double>& arrival, const ClockConvention& clock);

}  // namespace tilth
