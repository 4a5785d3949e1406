#include <algorithm>
#include <array>
#include <numbers>

#include <tilth/core/error.hpp>
#include <tilth/simulation/beam_flaws.hpp>
#include <tilth/simulation/counter_random.hpp>

namespace tilth {
namespace {

constexpr std::array<std::string_view, 3> kPresets{"ideal", "good", "worn"};
constexpr double kDegree = std::numbers::pi / 180;
constexpr std::uint64_t kRangeStream = 0xC0, kElevationStream = 0xC1, kAzimuthStream = 0xC2, kEncoderStream = 0xC3;

double draw(double deviation, std::uint64_t seed, std::uint64_t stream, std::size_t index) {
  return deviation * CounterRandom(seed, stream, index).normal();
}

std::vector<double> draw_list(double deviation, std::size_t rings, std::uint64_t seed, std::uint64_t stream) {
  std::vector<double> list(deviation == 0 ? 0 : rings);
  for (std::size_t ring = 0; ring < list.size(); ++ring) list[ring] = draw(deviation, seed, stream, ring);
  return list;
}

}  // namespace

std::span<const std::string_view> names_of(BeamPreset) {
  return kPresets;
}

BeamFlawOptions flaws_of(BeamPreset preset) {
  BeamFlawOptions flaws;
  flaws.beams = preset;
  if (preset == BeamPreset::good)
    flaws.beam_range = 0.005, flaws.beam_elevation = 0.02, flaws.walk = 0.005, flaws.encoder = 0.005;
  if (preset == BeamPreset::worn)
    flaws.beam_range = 0.02, flaws.beam_elevation = 0.15, flaws.walk = 0.02, flaws.encoder = 0.03;
  return flaws;
}

BeamModel draw_beams(const BeamFlawOptions& options, std::size_t rings, std::uint64_t seed) {
  BeamModel beams;
  beams.range = draw_list(options.beam_range, rings, seed, kRangeStream);
  beams.elevation = draw_list(options.beam_elevation * kDegree, rings, seed, kElevationStream);
  beams.azimuth = draw_list(options.beam_azimuth * kDegree, rings, seed, kAzimuthStream);
  for (int i = 0; i < 4; ++i) {
    beams.encoder[i] = draw((i < 2 ? 1.0 : 0.5) * options.encoder * kDegree, seed, kEncoderStream, std::size_t(i));
  }
  beams.range_scale = options.range_scale;
  beams.walk = options.walk;
  beams.bright = kBrightReturn;
  return beams;
}

double FlawedLidar::reported(std::size_t ring, double range, double intensity, double cosine) const {
  return reported_range(beams, ring, range, intensity) + walk_incidence * (1 - cosine);
}

FlawedLidar flawed_lidar(LidarModel lidar, const BeamFlawOptions& options, std::uint64_t scene_seed) {
  const std::uint64_t seed = options.beam_seed == 0 ? scene_seed : options.beam_seed;
  FlawedLidar flawed{std::move(lidar), {}, options.walk_incidence};
  flawed.beams = draw_beams(options, flawed.lidar.rings(), seed);
  if (flawed.lidar.rosette_angle > 0 && !flawed.ideal()) {
    throw Error("sensor " + flawed.lidar.name,
                "draws a rosette, and beams with errors are simulated of spinning sensors only: leave out beams, "
                "beam_range, beam_elevation, beam_azimuth, encoder, range_scale, walk and walk_incidence");
  }
  return flawed;
}

}  // namespace tilth
