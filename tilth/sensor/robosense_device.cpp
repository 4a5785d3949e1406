#include <algorithm>
#include <cmath>
#include <numbers>

#include <tilth/sensor/robosense_device.hpp>

namespace tilth {
namespace {

constexpr std::size_t kReturnMode = 300, kElevations = 468, kAzimuths = 564, kAngleSize = 3;
constexpr std::size_t kMostLasers = 32, kFewLasers = 16;
constexpr std::size_t kRs16Elevations = 1165, kRs16Downwards = 8;  ///< the first half points down
constexpr double kDegree = std::numbers::pi / 180.0, kHundredth = 0.01 * kDegree, kTenThousandth = 1e-4 * kDegree;
constexpr double kSteepest = 90.0 * kDegree;

std::uint32_t big(std::span<const std::byte> p, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value = value << 8 | std::to_integer<std::uint32_t>(p[at + i]);
  return value;
}

/// Sign (0: positive) and hundredths of a degree; nothing where it was never set.
std::optional<double> signed_angle(std::span<const std::byte> p, std::size_t at) {
  const std::uint32_t sign = big(p, at, 1);
  const double angle = big(p, at + 1, 2) * kHundredth;
  if (sign > 1 || angle > kSteepest) return std::nullopt;
  return sign == 0 ? angle : -angle;
}

std::optional<UnitCalibration> signed_angles(std::span<const std::byte> p, std::size_t lasers) {
  UnitCalibration unit{"its device packets", {}};
  for (std::size_t i = 0; i < lasers; ++i) {
    const auto elevation = signed_angle(p, kElevations + kAngleSize * i);
    const auto azimuth = signed_angle(p, kAzimuths + kAngleSize * i);
    if (!elevation || !azimuth) return std::nullopt;
    unit.lasers.push_back({*elevation, {.azimuth = *azimuth}});
  }
  const bool set =
      std::any_of(unit.lasers.begin(), unit.lasers.end(), [](const auto& l) { return l.elevation != 0.0; });
  return set ? std::optional(unit) : std::nullopt;
}

/// Only the first half of the places is set in a sensor of 16 lasers.
bool tells_16(std::span<const std::byte> p) {
  const auto unset = [&](std::size_t i) {
    const std::uint32_t value = big(p, kElevations + kAngleSize * i, kAngleSize);
    return value == 0 || value == 0xFFFFFF;
  };
  for (std::size_t i = kFewLasers; i < kMostLasers; ++i) {
    if (!unset(i)) return false;
  }
  return true;
}

std::optional<UnitCalibration> rs16_angles(std::span<const std::byte> p) {
  UnitCalibration unit{"its device packets", {}};
  for (std::size_t i = 0; i < kFewLasers; ++i) {
    const std::uint32_t value = big(p, kRs16Elevations + kAngleSize * i, kAngleSize);
    const double angle = value * kTenThousandth;
    if (value == 0 || angle > kSteepest) return std::nullopt;
    unit.lasers.push_back({i < kRs16Downwards ? -angle : angle, {}});
  }
  return unit;
}

void put_signed(PacketBytes& payload, std::size_t at, double angle) {
  payload[at] = std::byte(angle < 0.0 ? 1 : 0);
  put_big(payload, at + 1, std::uint64_t(std::lround(std::abs(angle) / kHundredth)), 2);
}

}  // namespace

RobosenseDevice parse_robosense_device(std::span<const std::byte> payload) {
  const bool dual = payload[kReturnMode] == std::byte(0);
  return {dual, signed_angles(payload, tells_16(payload) ? kFewLasers : kMostLasers), rs16_angles(payload)};
}

void put_robosense_angles(PacketBytes& payload, const PacketFormat& format) {
  payload[kReturnMode] = std::byte(format.family == PacketFamily::robosense ? 1 : 4);  // the strongest
  for (std::size_t i = 0; i < format.channels(); ++i) {
    if (format.name == "robosense_rs16") {
      const auto value = std::lround(std::abs(format.elevations[i]) / kTenThousandth);
      put_big(payload, kRs16Elevations + kAngleSize * i, std::uint64_t(value), kAngleSize);
      continue;
    }
    put_signed(payload, kElevations + kAngleSize * i, format.elevations[i]);
    put_signed(payload, kAzimuths + kAngleSize * i, format.offsets.empty() ? 0.0 : format.offsets[i].azimuth);
  }
}

}  // namespace tilth
