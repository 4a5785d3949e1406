// Arrays of numpy and the nouns of Tilth, one into the other. What comes in is read where it lies, whatever its strides
// and order; what goes out shares the memory of the object that it belongs to.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <string>
#include <utility>
#include <vector>

#include <tilth/core/scan.hpp>
#include <tilth/core/se3.hpp>
#include <tilth/core/trajectory.hpp>

namespace tilth::python {

namespace nb = nanobind;

using InputArray = nb::ndarray<nb::ro, nb::device::cpu>;
using PoseArray = nb::ndarray<nb::numpy, double, nb::shape<4, 4>>;
using Matrix6Array = nb::ndarray<nb::numpy, double, nb::shape<6, 6>>;
using Vector6Array = nb::ndarray<nb::numpy, double, nb::shape<6>>;
using PointArray = nb::ndarray<nb::numpy, double, nb::shape<-1, 3>>;
using MatrixArray = nb::ndarray<nb::numpy, double, nb::shape<-1, 3, 3>>;
using MapArray = nb::ndarray<nb::numpy, float, nb::shape<-1, 4>>;
using PosesArray = nb::ndarray<nb::numpy, double, nb::shape<-1, 4, 4>>;
template <class T>
using ColumnArray = nb::ndarray<nb::numpy, T, nb::shape<-1>>;

/// `object` as numpy.asarray makes an array of it: of float32 or float64 as it lies, else as a copy of float64. Throws
/// Error naming `name` where it holds no numbers.
InputArray number_array(nb::handle object, const std::string& name);

/// n x 3 numbers [m]; NaN and infinite ones pass. Throws Error naming `name` and the shape.
std::vector<Eigen::Vector3d> points_of(nb::handle object, const std::string& name);

/// The arrays of a scan; None: no such attribute. Throws Error naming the argument and its bound.
struct CloudArrays {
  nb::handle points, times, rings, intensities;
};
PointCloud cloud_of(const CloudArrays& arrays);

/// A 4 x 4 rigid motion, by default the identity. Throws Error where it is none within 1e-3.
Pose pose_of(nb::handle object, const std::string& name);

/// n stamps [s] that ascend and n x 4 x 4 poses. Throws Error naming the entry.
Trajectory trajectory_of(nb::handle stamps, nb::handle poses, const std::string& name);

/// `size` numbers. Throws Error naming `name` and the shape.
std::vector<double> numbers_of(nb::handle object, std::size_t size, const std::string& name);

PoseArray array_of(const Pose& pose);
Matrix6Array array_of(const Matrix6d& matrix);
Vector6Array array_of(const Vector6d& vector);
PosesArray array_of(const std::vector<Pose>& poses);
PosesArray poses_array(const Trajectory& trajectory);
ColumnArray<double> stamps_array(const Trajectory& trajectory);
PointArray array_of(std::vector<Eigen::Vector3d> points);

/// The pointer of an array may not be null, also where there is nothing in it.
template <class T>
T* never_null(T* data) {
  static std::remove_const_t<T> nothing{};
  return data == nullptr ? &nothing : data;
}

/// `values`, moved to where Python keeps them, as an array of type A and of that shape.
template <class A, class T>
A owned_array(std::vector<T> values, std::initializer_list<std::size_t> shape) {
  auto* const kept = new std::vector<T>(std::move(values));
  const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  return A(never_null(kept->data()), shape, owner);
}

template <class T>
ColumnArray<T> column_array(std::vector<T> values) {
  const std::size_t size = values.size();
  return owned_array<ColumnArray<T>>(std::move(values), {size});
}

/// `values`, which belong to `owner`, as they lie.
template <class T>
ColumnArray<T> column_view(std::vector<T>& values, nb::handle owner) {
  return ColumnArray<T>(never_null(values.data()), {values.size()}, owner);
}

}  // namespace tilth::python
