// Where a local map lies on the Earth: its origin and heading in a zone of UTM (WGS 84), and the coordinate reference
// system of that as well-known text (OGC 01-009), which LAS 1.4 asks for.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <tilth/core/se3.hpp>

namespace tilth {

struct UtmOrigin {
  int zone = 1;                         ///< 1 .. 60
  bool north = true;                    ///< hemisphere
  Pose T_utm_world = Pose::Identity();  ///< [m] easting, northing, height; turned about z alone
};

/// "32N,EASTING,NORTHING,HEIGHT[,HEADING]" in metres, and degrees from east to the x axis of the map, counterclockwise.
/// Throws Error saying what is wrong.
UtmOrigin parse_utm_origin(std::string_view text);

/// WGS 84 / UTM with its EPSG number; without an origin a local system in metres.
std::string well_known_text(const std::optional<UtmOrigin>& origin);

}  // namespace tilth
