// LAS 1.4 (ASPRS, revision R15), point format 6, uncompressed: for CloudCompare, QGIS, PDAL. Debian has no LAS library;
// the part that is written here is a header of 375 bytes, the coordinate reference system as well-known text, and 30
// bytes a point. O(n).
#pragma once

#include <filesystem>
#include <optional>

#include <tilth/core/point_records.hpp>
#include <tilth/io/utm_origin.hpp>

namespace tilth {

inline constexpr double kLasStep = 1e-4;  ///< [m] to which coordinates are rounded

/// Needs x y z [m]; writes intensity (rounded, 0 .. 65535) and, where they are, ring as user data (0 .. 255) and
/// `stamp` + time [s] as GPS time, other fields not. With an `origin` coordinates are those of UTM. Points that are not
/// finite are left out. Throws Error naming the missing field, or where the cloud is wider than 32 bits of kLasStep
/// hold (429 km).
void write_las(const std::filesystem::path& path, const PointRecords& records, double stamp = 0.0,
               const std::optional<UtmOrigin>& origin = std::nullopt);

}  // namespace tilth
