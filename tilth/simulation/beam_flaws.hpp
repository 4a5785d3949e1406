// What the beams of a simulated sensor report wrongly, the same in every scan: constant errors after the law of
// tilth/core/beam_model.hpp, and returns that read long at grazing incidence, which that law does not know.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include <tilth/core/beam_model.hpp>
#include <tilth/core/lidar_model.hpp>
#include <tilth/core/options.hpp>

namespace tilth {

/// What the other options of the flaws begin at.
enum class BeamPreset { ideal, good, worn };
std::span<const std::string_view> names_of(BeamPreset);

struct BeamFlawOptions {
  BeamPreset beams = BeamPreset::ideal;
  double beam_range = 0.0;      ///< [m] deviation
  double beam_elevation = 0.0;  ///< [deg] deviation
  double beam_azimuth = 0.0;    ///< [deg] deviation
  double encoder = 0.0;         ///< [deg] deviation of the first harmonic; half as much of the second
  double range_scale = 0.0;     ///< [-]
  double walk = 0.0;            ///< [m] of the darkest returns
  double walk_incidence = 0.0;  ///< [m] of grazing returns: times 1 - cosine of incidence
  std::uint64_t beam_seed = 0;  ///< 0: the scene's
};

template <class V>
void visit(BeamFlawOptions& o, V&& v) {
  v("beams", o.beams, "[-] flaws of the beams that the options below begin at: ideal has none, good few, worn many");
  v("beam_range", o.beam_range, Bounds{0, 0.2}, "[m] standard deviation of the constant range error of a beam");
  v("beam_elevation", o.beam_elevation, Bounds{0, 1}, "[deg] standard deviation of the elevation error of a beam");
  v("beam_azimuth", o.beam_azimuth, Bounds{0, 1}, "[deg] standard deviation of the azimuth error of a beam");
  v("encoder", o.encoder, Bounds{0, 1},
    "[deg] standard deviation of both coefficients of the encoder's first harmonic; half as much of the second");
  v("range_scale", o.range_scale, Bounds{-0.05, 0.05}, "[-] by which every range reads long, as a share of it");
  v("walk", o.walk, Bounds{-0.2, 0.2}, "[m] by which the darkest returns read long, bright ones not at all");
  v("walk_incidence", o.walk_incidence, Bounds{-0.2, 0.2},
    "[m] by which returns at grazing incidence read long: times 1 - cosine of incidence");
  v("beam_seed", o.beam_seed, Bounds{0, 9e15}, "[-] of the beams' errors; 0: the seed of the scene");
}

/// The options that a preset stands for.
BeamFlawOptions flaws_of(BeamPreset preset);

/// [0, 255] of the simulator's intensities: a light facade seen head on, from which on a return does not walk.
inline constexpr double kBrightReturn = 150.0;

/// The errors of `rings` beams. Each depends on the seed, its kind and its beam alone, and is in proportion to its
/// deviation; lists whose deviation is 0 are empty.
BeamModel draw_beams(const BeamFlawOptions& options, std::size_t rings, std::uint64_t seed);

/// A sensor, and what it reports wrongly.
struct FlawedLidar {
  LidarModel lidar;
  BeamModel beams = {};
  double walk_incidence = 0.0;  ///< [m]

  bool ideal() const { return beams.ideal() && walk_incidence == 0; }

  /// [m] what the beam of `ring` reports of a return at `range` [m] and that cosine of incidence.
  double reported(std::size_t ring, double range, double intensity, double cosine) const;
};

/// With the errors drawn from beam_seed or else `scene_seed`. Throws Error where a rosette is to have flaws.
FlawedLidar flawed_lidar(LidarModel lidar, const BeamFlawOptions& options, std::uint64_t scene_seed);

}  // namespace tilth
