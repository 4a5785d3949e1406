// When a point counts as one of something that moves. docs/clean_map.md says where the figures come from.
#pragma once

#include <cstddef>

namespace tilth {

struct MovingOptions {
  double voxel = 0.1;              ///< [m] edge of the voxels that are judged
  std::size_t most_beams = 40000;  ///< of a scan that are looked at; more are thinned evenly
  double reach = 30.0;             ///< [m] from the sensor that a voxel is looked at
  double near = 0.5;               ///< [m] from the sensor within which beams tell nothing: the robot itself
  double margin = 0.3;             ///< [m] that a beam must go on behind a point to have passed it
  double met = 0.1;                ///< [m] before or behind a point where a beam ends that has met it
  double beam_radius = 0.05;       ///< [m] from a point within which a beam tells something of it
  double clearance = 0.08;         ///< [m] from a plane within which beams that graze it tell nothing
  double grazing = 0.3;            ///< [-] sine of the angle to a plane below which a beam grazes it
  double thickness = 0.035;        ///< [m] standard deviation of points below which they are a plane
  double surprise = 3.0;      ///< [-] -ln of the chance of so many passes in a row over something that still stands
  double least_passes = 3.0;  ///< scans whose beams passed, at the least, before something has gone
  double stay = 3.0;          ///< [s] that something must be seen at a place which was free before
  double settled = 5.0;       ///< [s] from first to last sight of what stood, and left or came
  double firm_stay = 2.0;     ///< [s] from first to last sight of a voxel that is certain to stand
  std::size_t firm_hits = 5;  ///< scans that met it
};

}  // namespace tilth
