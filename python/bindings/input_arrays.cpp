#include <cmath>

#include "arrays.hpp"
#include <tilth/core/error.hpp>

namespace tilth::python {
namespace {

constexpr double kRigid = 1e-3;         // by which a rotation may miss being one
constexpr float kLongestScan = 10.0F;   // [s]
constexpr double kMostRings = 65535.0;  // as 16 bits hold

std::string shape_text(const InputArray& array) {
  std::string text = "(";
  for (std::size_t i = 0; i < array.ndim(); ++i) text += (i ? ", " : "") + std::to_string(array.shape(i));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

void require_shape(bool holds, const InputArray& array, const std::string& name, const std::string& wanted) {
  if (!holds) throw Error(name, "has the shape " + shape_text(array) + ", expected " + wanted);
}

void require_column(const InputArray& array, std::size_t size, const std::string& name) {
  require_shape(array.ndim() == 1 && array.shape(0) == size, array, name, "(" + std::to_string(size) + ",)");
}

/// numpy's letter for the kind of its elements.
std::string kind_of(nb::handle array) {
  return nb::cast<std::string>(array.attr("dtype").attr("kind"));
}

nb::object as_array(nb::handle object, const std::string& name) {
  try {
    return nb::module_::import_("numpy").attr("asarray")(object);
  } catch (nb::python_error& e) {
    if (!e.matches(PyExc_ValueError) && !e.matches(PyExc_TypeError)) throw;
    throw Error(name, std::string("is no array: ") + nb::str(e.value()).c_str());
  }
}

/// Whether elements can be read by pointers to them: native, aligned, and a whole number of them apart.
bool is_plain(nb::handle array) {
  const auto size = nb::cast<long>(array.attr("itemsize"));
  if (!nb::cast<bool>(array.attr("dtype").attr("isnative")) || !nb::cast<bool>(array.attr("flags").attr("aligned")))
    return false;
  for (const nb::handle stride : array.attr("strides")) {
    if (nb::cast<long>(stride) % size != 0) return false;
  }
  return true;
}

/// Calls f(data) with the pointer to the elements, of float or double.
template <class F>
void with_elements(const InputArray& array, const F& f) {
  if (array.dtype() == nb::dtype<float>())
    f(static_cast<const float*>(array.data()));
  else
    f(static_cast<const double*>(array.data()));
}

/// `size` elements that lie `stride` of them apart.
template <class T, class E>
std::vector<T> spread(const E* data, std::size_t size, std::int64_t stride) {
  if (stride == 1) return std::vector<T>(data, data + size);
  std::vector<T> values(size);
  for (std::size_t i = 0; i < size; ++i) values[i] = T(data[std::int64_t(i) * stride]);
  return values;
}

template <class T>
std::vector<T> column_of(nb::handle object, std::size_t size, const std::string& name) {
  const InputArray array = number_array(object, name);
  require_column(array, size, name);
  std::vector<T> values;
  with_elements(array, [&](const auto* data) { values = spread<T>(data, size, array.stride(0)); });
  return values;
}

std::string entry(const std::string& name, std::size_t i) {
  return name + "[" + std::to_string(i) + "]";
}

std::vector<float> times_of(nb::handle object, std::size_t size) {
  std::vector<float> times = column_of<float>(object, size, "times");
  const auto is_time = [](float time) { return bool(int(time >= 0) & int(time <= kLongestScan)); };
  int wrong = 0;
  for (const float time : times) wrong |= int(!is_time(time));  // without a branch: quickly
  for (std::size_t i = 0; wrong != 0 && i < size; ++i) {
    if (is_time(times[i])) continue;
    throw Error(entry("times", i), "is " + std::to_string(times[i]) +
                                       ", expected seconds since the stamp of the scan, 0 .. " +
                                       std::to_string(int(kLongestScan)));
  }
  return times;
}

std::vector<std::uint16_t> rings_of(nb::handle object, std::size_t size) {
  const nb::object array = as_array(object, "rings");
  const std::string kind = kind_of(array);
  if (kind != "u" && kind != "i") throw Error("rings", "are no integers");
  if (kind == "u" && nb::cast<std::size_t>(array.attr("itemsize")) == sizeof(std::uint16_t) && is_plain(array)) {
    const auto plain = nb::cast<InputArray>(array);
    require_column(plain, size, "rings");
    return spread<std::uint16_t>(static_cast<const std::uint16_t*>(plain.data()), size, plain.stride(0));
  }
  const std::vector<double> numbers = column_of<double>(object, size, "rings");
  std::vector<std::uint16_t> rings(size);
  for (std::size_t i = 0; i < size; ++i) {
    if (!(numbers[i] >= 0 && numbers[i] <= kMostRings))
      throw Error(entry("rings", i), "is " + std::to_string(numbers[i]) + ", expected 0 .. 65535, 0 the lowest beam");
    rings[i] = std::uint16_t(numbers[i]);
  }
  return rings;
}

Pose rigid(const Eigen::Matrix4d& matrix, const std::string& name) {
  const Eigen::Matrix3d R = matrix.topLeftCorner<3, 3>();
  const bool is_rotation = (R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < kRigid && R.determinant() > 0;
  if (!matrix.allFinite() || !is_rotation || matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    throw Error(name, "is no rigid motion: expected a rotation (within 1e-3), a translation and the row 0 0 0 1");
  return Pose(matrix);
}

/// The 4 x 4 numbers of pose `i` of an array of poses, or of one pose.
Eigen::Matrix4d matrix_at(const InputArray& array, std::size_t i) {
  const std::size_t first = array.ndim() - 2;
  const std::int64_t begin = first == 1 ? std::int64_t(i) * array.stride(0) : 0;
  Eigen::Matrix4d matrix;
  with_elements(array, [&](const auto* data) {
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 4; ++column)
        matrix(row, column) = double(data[begin + row * array.stride(first) + column * array.stride(first + 1)]);
    }
  });
  return matrix;
}

}  // namespace

InputArray number_array(nb::handle object, const std::string& name) {
  nb::object array = as_array(object, name);
  const std::string kind = kind_of(array);
  if (kind != "f" && kind != "i" && kind != "u")
    throw Error(name, "has elements of type " + std::string(nb::str(nb::object(array.attr("dtype"))).c_str()) +
                          ", expected numbers");
  const auto size = nb::cast<std::size_t>(array.attr("itemsize"));
  if (kind != "f" || (size != sizeof(float) && size != sizeof(double)) || !is_plain(array))
    array = nb::module_::import_("numpy").attr("ascontiguousarray")(array, "float64");
  return nb::cast<InputArray>(array);
}

std::vector<Eigen::Vector3d> points_of(nb::handle object, const std::string& name) {
  const InputArray array = number_array(object, name);
  require_shape(array.ndim() == 2 && array.shape(1) == 3, array, name, "(n, 3): x y z [m] of each point");
  std::vector<Eigen::Vector3d> points(array.shape(0));
  with_elements(array, [&](const auto* data) {
    const std::int64_t row = array.stride(0), step = array.stride(1);
    for (std::size_t i = 0; i < points.size(); ++i, data += row)
      points[i] = {double(data[0]), double(data[step]), double(data[2 * step])};
  });
  return points;
}

PointCloud cloud_of(const CloudArrays& arrays) {
  PointCloud cloud;
  cloud.points = points_of(arrays.points, "points");
  const std::size_t size = cloud.size();
  if (!arrays.times.is_none()) cloud.times = times_of(arrays.times, size);
  if (!arrays.rings.is_none()) cloud.rings = rings_of(arrays.rings, size);
  if (!arrays.intensities.is_none()) cloud.intensities = column_of<float>(arrays.intensities, size, "intensities");
  return cloud;
}

Pose pose_of(nb::handle object, const std::string& name) {
  if (object.is_none()) return Pose::Identity();
  const InputArray array = number_array(object, name);
  require_shape(array.ndim() == 2 && array.shape(0) == 4 && array.shape(1) == 4, array, name, "(4, 4)");
  return rigid(matrix_at(array, 0), name);
}

Trajectory trajectory_of(nb::handle stamps, nb::handle poses, const std::string& name) {
  const InputArray array = number_array(poses, name + ".poses");
  require_shape(array.ndim() == 3 && array.shape(1) == 4 && array.shape(2) == 4, array, name + ".poses", "(n, 4, 4)");
  const std::vector<double> times = column_of<double>(stamps, array.shape(0), name + ".stamps");
  Trajectory trajectory;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || (i > 0 && times[i] <= times[i - 1]))
      throw Error(entry(name + ".stamps", i), "is " + std::to_string(times[i]) + ", expected stamps [s] that ascend");
    trajectory.push_back({times[i], rigid(matrix_at(array, i), entry(name + ".poses", i))});
  }
  return trajectory;
}

std::vector<double> numbers_of(nb::handle object, std::size_t size, const std::string& name) {
  return column_of<double>(object, size, name);
}

}  // namespace tilth::python
