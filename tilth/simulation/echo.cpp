#include <algorithm>
#include <cmath>

#include <tilth/simulation/echo.hpp>

namespace tilth {
namespace {

constexpr double kGrazing = 0.06;        // cosine of incidence below which a matte surface loses returns
constexpr double kGlossyGrazing = 0.35;  // the same of a polished floor
constexpr double kMetalGrazing = 0.5;    // the same of bare metal
constexpr double kMixedGap = 0.15;       // [m] apart at least, to be taken for two surfaces
constexpr double kSamePlane = 0.03;      // [m] from the tangent plane within which it is one surface after all
constexpr double kStrayGap = 0.3;        // [m] of a stray range from the surface at least
constexpr double kPaneReturn = 0.15;     // share of the beams that a pane of glass scatters back
constexpr double kPastSurface = 1e-4;    // [m] by which a beam that goes on starts beyond

/// Share of the beams that a surface throws past the receiver: none down to a cosine of incidence, then ever more.
double loss_at(Material material, double cosine, const NoiseOptions& options) {
  switch (material) {
    case Material::metal: return options.glossy * (1 - cosine / kMetalGrazing);
    case Material::glossy: return options.glossy * (1 - cosine / kGlossyGrazing);
    default: return options.grazing * (1 - cosine / kGrazing);
  }
}

double cosine_of(const Ray& ray, const Hit& hit) {
  return std::abs(ray.direction.dot(hit.normal));
}

Ray mirrored(const Ray& ray, const Hit& hit) {
  const Eigen::Vector3d point = ray.origin + hit.distance * ray.direction;
  return {point + kPastSurface * hit.normal, ray.direction - 2 * ray.direction.dot(hit.normal) * hit.normal, ray.time};
}

Echo plain_echo(const Ray& ray, const Hit& hit) {
  const double cosine = cosine_of(ray, hit), brightness = hit.surface->reflectivity * (0.3 + 0.7 * cosine);
  const PointKind kind = hit.moving ? PointKind::moving : PointKind::surface;
  return {hit.distance, kind, hit.edge_distance, 255 * brightness, cosine};
}

}  // namespace

std::optional<Onward> onward(const Ray& ray, const Hit& hit, const NoiseOptions& options, CounterRandom& random) {
  const Material material = hit.surface->material;
  if (material != Material::metal && material != Material::glass) return std::nullopt;
  if (random.chance(options.ghosts * (1 - cosine_of(ray, hit)))) return Onward{mirrored(ray, hit), true};
  if (material == Material::metal || random.chance(kPaneReturn)) return std::nullopt;
  const Eigen::Vector3d beyond = ray.origin + (hit.distance + kPastSurface) * ray.direction;
  return Onward{{beyond, ray.direction, ray.time}, false};
}

std::optional<Echo> echo_of(const Ray& ray, const Hit& hit, const NoiseOptions& options, CounterRandom& random) {
  if (!hit.met()) return std::nullopt;
  if (random.chance(loss_at(hit.surface->material, cosine_of(ray, hit), options))) return std::nullopt;
  return plain_echo(ray, hit);
}

std::optional<Echo> onward_echo(const Onward& next, const Hit& hit, double before) {
  if (!hit.met()) return std::nullopt;
  Echo echo = plain_echo(next.ray, hit);
  echo.range += before;
  if (next.mirrored) echo.kind = PointKind::ghost, echo.edge_distance = std::numeric_limits<double>::infinity();
  return echo;
}

void mix(Echo& echo, const Sight& seen, const Sight& beside, const NoiseOptions& options, CounterRandom& random) {
  if (!beside.hit.met() || std::abs(beside.hit.distance - echo.range) < kMixedGap) return;
  const Eigen::Vector3d step = beside.point() - seen.point();
  const bool same_plane = std::abs(step.dot(seen.hit.normal)) < kSamePlane;
  if (same_plane || !random.chance(options.mixed)) return;
  const double ratio = random.uniform(0.1, 0.9);
  echo.range += ratio * (beside.hit.distance - echo.range);
  echo.kind = PointKind::mixed;
}

void stray(Echo& echo, const Hit& seen, const NoiseOptions& options, CounterRandom& random) {
  if (!random.chance(options.outliers)) return;
  const double surface = seen.distance;
  echo.range = random.uniform(0, 2 * surface);
  if (std::abs(echo.range - surface) < kStrayGap) echo.range = surface + std::copysign(kStrayGap, echo.range - surface);
  echo.kind = PointKind::outlier;
  echo.edge_distance = std::numeric_limits<double>::infinity();
}

std::optional<double> measured_range(const Echo& echo, const LidarModel& lidar, const NoiseOptions& options,
                                     CounterRandom& random) {
  double range = echo.range + options.noise * random.normal();
  if (options.quantize) range = std::round(range / lidar.range_step) * lidar.range_step;
  if (range < lidar.min_range || range > lidar.max_range) return std::nullopt;
  return range;
}

}  // namespace tilth
