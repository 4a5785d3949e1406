// What an HDL-64E S2 or S3 tells in the status byte of its packets: 16 packets give date, temperature and seven bytes
// of a table of 1820, which begins with UNIT# and holds the unit's calibration (manual of the S3, appendix E).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <tilth/sensor/unit_calibration.hpp>

namespace tilth {

struct StatusByte {
  std::uint8_t type = 0, value = 0;
};

inline constexpr std::size_t kPacketsOfCalibration = 4160;  ///< that tell the whole of it, wherever they begin

/// The calibration that these packets tell, one byte each, none of them missing; nothing where they are too few, or
/// the table's checksum is wrong, or the unit was never calibrated (its date is not set). The length tells an S2's
/// table, a CRC-16 an S3's.
std::optional<UnitCalibration> hdl64_calibration(std::span<const StatusByte> bytes);

/// The status bytes of kPacketsOfCalibration packets that tell `unit`, of 64 lasers, rounded to 0.01 degrees and 1 mm.
std::vector<StatusByte> hdl64_status_bytes(const UnitCalibration& unit, bool s3);

}  // namespace tilth
