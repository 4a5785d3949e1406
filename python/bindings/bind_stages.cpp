// Single stages: outliers, deskewing, neighbours, patches of surface.
#include <nanobind/stl/map.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "finite_points.hpp"
#include "records.hpp"
#include <tilth/core/error.hpp>
#include <tilth/features/surface_patches.hpp>
#include <tilth/preprocess/deskew.hpp>
#include <tilth/preprocess/outlier_removal.hpp>
#include <tilth/search/scan_neighbors.hpp>

namespace tilth::python {
namespace {

ColumnArray<bool> inliers(const Scan& scan, const OptionValues& values) {
  const auto options = with<OutlierOptions>(values);
  const FinitePoints finite(scan.cloud);
  const NeighborTable table =
      options.method == OutlierMethod::support ? NeighborTable{} : scan_neighbors(finite.cloud, std::size_t(options.k));
  const std::vector<std::uint8_t> keep = keep_inliers(finite.cloud, table, options);
  auto* const kept = new bool[std::max<std::size_t>(1, scan.cloud.size())]{};
  const nb::capsule owner(kept, [](void* p) noexcept { delete[] static_cast<bool*>(p); });
  for (std::size_t i = 0; i < keep.size(); ++i) kept[finite.indices[i]] = keep[i] != 0;
  return ColumnArray<bool>(kept, {scan.cloud.size()}, owner);
}

Scan deskewed(const Scan& scan, nb::handle velocity, double reference_time) {
  const std::vector<double> numbers = numbers_of(velocity, 6, "velocity");
  if (!scan.cloud.has_times() && !scan.cloud.empty()) throw Error("scan", "has no times to be deskewed by");
  if (!std::isfinite(reference_time)) throw Error("reference_time", "is not finite: expected seconds since the stamp");
  MotionInScan motion;
  motion.velocity = Eigen::Map<const Vector6d>(numbers.data());
  if (!motion.velocity.allFinite()) throw Error("velocity", "is not finite");
  motion.begin = -reference_time;
  motion.duration = duration(scan.cloud);
  return {scan.stamp, deskew(scan.cloud, motion, reference_time)};
}

template <class T>
using NeighborArray = nb::ndarray<nb::numpy, T, nb::shape<-1, -1>>;
using Neighbours = std::pair<NeighborArray<std::uint32_t>, NeighborArray<float>>;

/// Indices and distances [m], n x k.
Neighbours neighbors(const Scan& scan, std::size_t k) {
  NeighborTable table;
  {
    const nb::gil_scoped_release unlocked;
    for (std::size_t i = 0; i < scan.cloud.size(); ++i) {
      if (!scan.cloud.points[i].allFinite())
        throw Error("points[" + std::to_string(i) + "]", "is not finite: neighbours need finite points");
    }
    table = scan_neighbors(scan.cloud, k);
    for (float& distance : table.squared_distances) distance = std::sqrt(distance);
  }
  const std::size_t rows = scan.cloud.size();
  return {owned_array<NeighborArray<std::uint32_t>>(std::move(table.indices), {rows, table.k}),
          owned_array<NeighborArray<float>>(std::move(table.squared_distances), {rows, table.k})};
}

template <class T, class F>
ColumnArray<T> column_of_patches(const SurfacePatches& patches, const F& of) {
  std::vector<T> values;
  for (const SurfacePatch& patch : patches) values.push_back(of(patch));
  return column_array(std::move(values));
}

template <class F>
PointArray vectors_of_patches(const SurfacePatches& patches, const F& of) {
  std::vector<Eigen::Vector3d> vectors;
  for (const SurfacePatch& patch : patches) vectors.push_back(of(patch));
  return array_of(std::move(vectors));
}

MatrixArray covariances_of(const SurfacePatches& patches) {
  auto* const data = new double[std::max<std::size_t>(1, 9 * patches.size())];
  const nb::capsule owner(data, [](void* p) noexcept { delete[] static_cast<double*>(p); });
  for (std::size_t i = 0; i < patches.size(); ++i)
    Eigen::Map<Eigen::Matrix3d>(data + 9 * i) = patches[i].covariance;  // symmetric: either order
  return MatrixArray(data, {patches.size(), 3, 3}, owner);
}

NamedValues patches_of(const Scan& scan, const OptionValues& values) {
  using P = const SurfacePatch&;
  const SurfacePatches patches = surface_patches(FinitePoints(scan.cloud).cloud, with<PatchOptions>(values));
  nb::dict columns;
  columns["means"] = vectors_of_patches(patches, [](P p) { return p.mean; });
  columns["covariances"] = covariances_of(patches);
  columns["normals"] = vectors_of_patches(patches, [](P p) { return p.normal; });
  columns["times"] = column_of_patches<float>(patches, [](P p) { return p.time; });
  columns["thickness"] = column_of_patches<float>(patches, [](P p) { return p.thickness; });
  columns["points"] = column_of_patches<std::uint16_t>(patches, [](P p) { return p.points; });
  columns["rings"] = column_of_patches<std::uint16_t>(patches, [](P p) { return p.ring; });
  columns["flat"] =
      nb::cast(column_of_patches<std::uint8_t>(patches, [](P p) { return std::uint8_t(p.flat); })).attr("view")("bool");
  return nb::borrow<NamedValues>(columns);
}

}  // namespace

void add_stages(nb::module_& module) {
  module.def("inliers", &inliers);
  module.def("deskew", &deskewed);
  module.def("neighbors", &neighbors);
  module.def("patches", &patches_of);
}

}  // namespace tilth::python
