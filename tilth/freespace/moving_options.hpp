// When a point counts as one of something that moves. docs/clean_map.md says where the figures come from.
#pragma once

#include <cstddef>

namespace tilth {

struct MovingOptions {
  double voxel = 0.1;          ///< [m] edge of the voxels that are judged
  std::size_t every = 12;      ///< of the points of a scan one in so many is followed as a beam; another one each scan
  double reach = 25.0;         ///< [m] along a beam that it is followed
  double near = 0.5;           ///< [m] along a beam that tells nothing: the robot itself
  double margin = 0.3;         ///< [m] before its end that a beam tells nothing
  double beam_radius = 0.025;  ///< [m] from the middle of a voxel's points that a beam must pass to count against them
  double clearance = 0.08;     ///< [m] from a plane within which beams that graze it tell nothing
  double grazing = 0.3;        ///< [-] sine of the angle to a plane below which a beam grazes it
  double thickness = 0.035;    ///< [m] standard deviation of points below which they are a plane
  double surprise = 3.0;       ///< [-] -ln of the chance of so many passes in a row over something that still stands
  std::size_t least_passes = 3;  ///< scans whose beams passed, at the least, before something has gone
  double stay = 3.0;             ///< [s] that something must be seen at a place which was free before
  double firm_stay = 2.0;        ///< [s] from first to last sight of a voxel that is certain to stand
  std::size_t firm_hits = 5;     ///< scans that saw it
};

}  // namespace tilth
