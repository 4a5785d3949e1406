#include <algorithm>
#include <array>

#include <tilth/sensor/clock_convention.hpp>
#include <tilth/sensor/utc.hpp>

namespace tilth {
namespace {

constexpr double kHour = 3600.0;
constexpr std::uint32_t kSecond = 1'000'000;  // [us]

/// [s] since 1970: a date, or a number whose first byte is not used (PTP). Zero where the clock was not set.
double whole_seconds(const std::array<std::uint8_t, 6>& t) {
  if (const auto utc = utc_seconds({2000 + t[0], t[1], t[2], t[3], t[4], double(t[5])})) return *utc;
  double seconds = t[1];
  for (std::size_t i = 2; i < t.size(); ++i) seconds = seconds * 256.0 + t[i];
  return seconds > kEarliestClock && seconds < kLatestClock ? seconds : 0.0;
}

}  // namespace

ClockConvention decide_clock(std::span<const DataPacket> first, const PacketFormat& format,
                             const std::optional<ClockTraits::Mark>& mark) {
  ClockConvention clock;
  clock.traits.step = format.packet_period(first.front().dual());
  clock.traits.mark = mark;
  clock.traits.wrap = kHour;
  if (!first.front().dated() && format.family != PacketFamily::leishen_1206) return clock;
  if (format.family == PacketFamily::leishen_1206) {
    const auto beyond = [](const DataPacket& p) { return !p.dated() && p.microseconds() > kSecond; };
    if (std::none_of(first.begin(), first.end(), beyond)) clock.traits.wrap = 1.0;
    return clock;
  }
  const auto beyond = [](const DataPacket& p) { return p.dated() && p.fraction() >= kSecond; };
  if (std::any_of(first.begin(), first.end(), beyond)) clock.fraction_unit = 1e-9;
  clock.traits.absolute = whole_seconds(first.front().whole_time()) > kEarliestClock;
  clock.traits.wrap = clock.traits.absolute ? 0.0 : 1.0;
  return clock;
}

ClockReading read_clock(const DataPacket& packet, const std::optional<double>& arrival, const ClockConvention& clock) {
  if (!packet.dated()) return {packet.microseconds() * 1e-6, arrival};
  const double whole = clock.traits.absolute ? whole_seconds(packet.whole_time()) : 0.0;
  return {whole + packet.fraction() * clock.fraction_unit, arrival};
}

}  // namespace tilth
