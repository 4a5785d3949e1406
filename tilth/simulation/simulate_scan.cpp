#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include <tilth/core/parallel.hpp>
#include <tilth/simulation/echo.hpp>
#include <tilth/simulation/pose_track.hpp>
#include <tilth/simulation/simulate_scan.hpp>

namespace tilth {
namespace {

constexpr std::size_t kColumnsAtOnce = 64;
constexpr std::array<std::string_view, 5> kKinds{"surface", "outlier", "mixed", "ghost", "moving"};

struct Beam {
  std::size_t ring;
  double time;                        // [s] since the scan's stamp
  Eigen::Vector3d origin, direction;  // in the LiDAR frame, as the sensor believes it points
  Ray ray;                            // in the world frame
  CounterRandom random;
};

/// All that one scan is made from.
struct Setting {
  const World& world;
  const FlawedLidar& sensor;
  bool ideal;  // the sensor
  const LidarModel& lidar;
  const Trajectory& trajectory;
  const NoiseOptions& options;
  const ScanKey& key;
  std::vector<std::size_t> ring_order;  // by the time they fire
};

std::vector<std::size_t> rings_as_they_fire(const LidarModel& lidar) {
  std::vector<std::size_t> order(lidar.rings());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return lidar.firing_offsets[a] < lidar.firing_offsets[b]; });
  return order;
}

Beam aim(const Setting& s, PoseTrack& track, std::size_t column, std::size_t slot) {
  const std::size_t ring = s.ring_order[slot];
  const double fired = s.options.snapshot ? 0 : s.lidar.time_of(column, ring);
  const double turned = s.options.snapshot ? double(column) * s.lidar.period / double(s.lidar.columns) : fired;
  const double drawn = s.lidar.rosette_angle > 0 ? s.key.stamp + turned : turned;  // a rosette goes on over the scans
  const Eigen::Vector3d origin = s.lidar.origin(turned), direction = s.lidar.direction(ring, drawn);
  const Eigen::Vector3d aimed = s.ideal ? direction : true_direction(s.sensor.beams, ring, direction);
  const Pose T_world_lidar = track.at(s.key.stamp + fired);
  return {ring,
          fired,
          origin,
          direction,
          {T_world_lidar * origin, T_world_lidar.linear() * aimed, s.key.stamp + fired},
          CounterRandom(s.key.seed, s.key.index, column * s.lidar.rings() + slot)};
}

std::vector<Beam> aim_columns(const Setting& s, std::size_t begin, std::size_t end) {
  PoseTrack track(s.trajectory);
  std::vector<Beam> beams;
  beams.reserve((end - begin) * s.lidar.rings());
  for (std::size_t column = begin; column < end; ++column) {
    for (std::size_t slot = 0; slot < s.lidar.rings(); ++slot) beams.push_back(aim(s, track, column, slot));
  }
  return beams;
}

/// A direction within the cone of the beam.
Ray within_beam(const Ray& ray, double divergence, CounterRandom& random) {
  const double radius = 0.5 * divergence * std::sqrt(random.uniform());
  const double angle = 2 * std::numbers::pi * random.uniform();
  const Eigen::Vector3d side = ray.direction.unitOrthogonal(), up = ray.direction.cross(side);
  const Eigen::Vector3d d = ray.direction + radius * (std::cos(angle) * side + std::sin(angle) * up);
  return {ray.origin, d.normalized(), ray.time};
}

struct Cast {
  std::vector<Ray> rays;
  std::vector<Hit> hits;

  Sight at(std::size_t i) const { return {rays[i], hits[i]}; }
};

/// Casts one ray for each beam.
template <class F>
Cast cast_each(const World& world, std::vector<Beam>& beams, const F& ray_of) {
  Cast cast{std::vector<Ray>(beams.size()), {}};
  std::transform(beams.begin(), beams.end(), cast.rays.begin(), ray_of);
  cast.hits = world.cast(cast.rays);
  return cast;
}

/// Echoes of all beams, those mirrored or let through by a pane included.
std::vector<std::optional<Echo>> echoes_of(const Setting& s, std::vector<Beam>& beams, const std::vector<Hit>& hits) {
  std::vector<std::optional<Echo>> echoes(beams.size());
  std::vector<std::size_t> indices;
  std::vector<Onward> onwards;
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (!hits[i].met()) continue;
    const std::optional<Onward> next = onward(beams[i].ray, hits[i], s.options, beams[i].random);
    if (!next) {
      echoes[i] = echo_of(beams[i].ray, hits[i], s.options, beams[i].random);
      continue;
    }
    indices.push_back(i), onwards.push_back(*next), rays.push_back(next->ray);
  }
  const std::vector<Hit> later = s.world.cast(rays);
  for (std::size_t k = 0; k < indices.size(); ++k) {
    echoes[indices[k]] = onward_echo(onwards[k], later[k], hits[indices[k]].distance);
  }
  return echoes;
}

/// As flawed beams report it: they take the intensity as it goes into the packets.
void distort(const Setting& s, const Beam& beam, Echo& echo) {
  echo.range = s.sensor.reported(beam.ring, echo.range, std::round(echo.intensity), echo.cosine);
}

void append_point(LabelledScan& out, const Setting& s, const Beam& beam, const Echo& echo, double range) {
  out.scan.cloud.points.push_back(beam.origin + range * beam.direction);
  out.scan.cloud.intensities.push_back(float(std::round(echo.intensity)));
  out.scan.cloud.rings.push_back(std::uint16_t(beam.ring));
  out.scan.cloud.times.push_back(s.options.snapshot ? 0.0F : float(beam.time));
  const bool on_edge = echo.edge_distance <= kEdgeReach;
  out.labels.push_back(std::uint8_t(std::uint8_t(echo.kind) | (on_edge ? kEdgeBit : 0)));
}

LabelledScan simulate_columns(const Setting& s, std::size_t begin, std::size_t end) {
  std::vector<Beam> beams = aim_columns(s, begin, end);
  const Cast seen = cast_each(s.world, beams, [](const Beam& beam) { return beam.ray; });
  Cast beside;
  if (s.options.mixed > 0) {
    const auto aside = [&](Beam& beam) { return within_beam(beam.ray, s.options.divergence, beam.random); };
    beside = cast_each(s.world, beams, aside);
  }
  std::vector<std::optional<Echo>> echoes = echoes_of(s, beams, seen.hits);
  LabelledScan out;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (!echoes[i]) continue;
    const bool direct = echoes[i]->range == seen.hits[i].distance;
    if (direct && s.options.mixed > 0) mix(*echoes[i], seen.at(i), beside.at(i), s.options, beams[i].random);
    stray(*echoes[i], seen.hits[i], s.options, beams[i].random);
    if (!s.ideal) distort(s, beams[i], *echoes[i]);
    const std::optional<double> range = measured_range(*echoes[i], s.lidar, s.options, beams[i].random);
    if (range) append_point(out, s, beams[i], *echoes[i], *range);
  }
  return out;
}

}  // namespace

std::span<const std::string_view> names_of(PointKind) {
  return kKinds;
}

NoiseOptions gazebo_noise() {
  NoiseOptions options;
  options.noise = 0.008;
  options.outliers = options.mixed = options.ghosts = options.grazing = options.glossy = 0;
  options.quantize = false;
  options.snapshot = true;
  return options;
}

LabelledScan simulate_scan(const World& world, const FlawedLidar& sensor, const Trajectory& trajectory,
                           const NoiseOptions& options, const ScanKey& key) {
  const LidarModel& lidar = sensor.lidar;
  const Setting setting{world, sensor, sensor.ideal(), lidar, trajectory, options, key, rings_as_they_fire(lidar)};
  std::vector<LabelledScan> parts((lidar.columns + kColumnsAtOnce - 1) / kColumnsAtOnce);
  parallel_for(lidar.columns, kColumnsAtOnce, [&](std::size_t begin, std::size_t end) {
    parts[begin / kColumnsAtOnce] = simulate_columns(setting, begin, end);
  });
  LabelledScan whole;
  whole.scan.stamp = key.stamp;
  for (const LabelledScan& part : parts) {
    if (part.labels.empty()) continue;
    append(whole.scan.cloud, part.scan.cloud);
    whole.labels.insert(whole.labels.end(), part.labels.begin(), part.labels.end());
  }
  return whole;
}

}  // namespace tilth
