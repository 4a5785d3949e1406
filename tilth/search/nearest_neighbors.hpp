// What registration and maps ask of a set of points: the nearest neighbours of a place.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace tilth {

struct Neighbor {
  std::uint32_t index = 0;        ///< of the point in the cloud that was searched
  double squared_distance = 0.0;  ///< [m^2]
};

/// Anything that finds nearest neighbours. `knn` fills its vector with the min(k, size) nearest, nearest first (a
/// vector that is used again costs no allocation); `nearest` is empty where there are no points.
template <class S>
concept NearestNeighbors = requires(const S& s, const Eigen::Vector3d& query, std::size_t k,
                                    std::vector<Neighbor>& out) {
  {s.knn(query, k, out)};
  { s.nearest(query) } -> std::same_as<std::optional<Neighbor>>;
  { s.size() } -> std::convertible_to<std::size_t>;
};

}  // namespace tilth
