// tilth.Scan: a scan as arrays.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "docstrings.hpp"
#include <tilth/core/error.hpp>

namespace tilth::python {
namespace {

struct ScanArrays {
  CloudArrays cloud;
  nb::handle T_cloud_sensor;
  double stamp;
};

PointArray points_view(nb::pointer_and_handle<Scan> self) {
  std::vector<Eigen::Vector3d>& points = self.p->cloud.points;
  return PointArray(never_null(points.empty() ? nullptr : points.front().data()), {points.size(), 3}, self.h);
}

/// An attribute of the cloud as it lies; None where the scan has none.
template <class T>
std::optional<ColumnArray<T>> attribute_view(nb::pointer_and_handle<Scan> self, std::vector<T> PointCloud::*attribute) {
  std::vector<T>& values = self.p->cloud.*attribute;
  if (values.empty() || values.size() != self.p->cloud.size()) return std::nullopt;
  return column_view(values, self.h);
}

void make_scan(Scan* self, const ScanArrays& arrays) {
  if (!std::isfinite(arrays.stamp)) throw Error("stamp", "is not finite: expected seconds");
  Scan scan{arrays.stamp, cloud_of(arrays.cloud)};
  if (!arrays.T_cloud_sensor.is_none()) scan.T_cloud_sensor = pose_of(arrays.T_cloud_sensor, "T_cloud_sensor");
  new (self) Scan(std::move(scan));
}

std::string scan_text(const Scan& scan) {
  std::string text = "Scan(stamp=" + std::to_string(scan.stamp) + ", " + std::to_string(scan.cloud.size()) + " points";
  if (scan.cloud.has_times()) text += ", times";
  if (scan.cloud.has_rings()) text += ", rings";
  return text + (scan.cloud.intensities.empty() ? ")" : ", intensities)");
}

}  // namespace

void add_scan(nb::module_& module) {
  nb::class_<Scan>(module, "Scan", kScanDoc)
      .def(
          "__init__",
          [](Scan* self, nb::handle points, nb::handle times, nb::handle rings, nb::handle intensities, double stamp,
             nb::handle T_cloud_sensor) {
            make_scan(self, {{points, times, rings, intensities}, T_cloud_sensor, stamp});
          },
          nb::arg("points"), nb::arg("times").none() = nb::none(), nb::arg("rings").none() = nb::none(),
          nb::arg("intensities").none() = nb::none(), nb::kw_only(), nb::arg("stamp"),
          nb::arg("T_cloud_sensor").none() = nb::none(),
          nb::sig("def __init__(self, points: numpy.typing.ArrayLike, times: numpy.typing.ArrayLike | None = None, "
                  "rings: numpy.typing.ArrayLike | None = None, intensities: numpy.typing.ArrayLike | None = None, *, "
                  "stamp: float, T_cloud_sensor: numpy.typing.ArrayLike | None = None) -> None"))
      .def_ro("stamp", &Scan::stamp, "[s] of the first point; `times` count from here.")
      .def_prop_ro("points", &points_view, "(n, 3) float64 [m] in the LiDAR frame, each as seen at its own time.")
      .def_prop_ro(
          "times", [](nb::pointer_and_handle<Scan> self) { return attribute_view<float>(self, &PointCloud::times); },
          "(n,) float32 [s] since `stamp`, or None.")
      .def_prop_ro(
          "rings",
          [](nb::pointer_and_handle<Scan> self) { return attribute_view<std::uint16_t>(self, &PointCloud::rings); },
          "(n,) uint16, 0 the lowest beam, or None.")
      .def_prop_ro(
          "intensities",
          [](nb::pointer_and_handle<Scan> self) { return attribute_view<float>(self, &PointCloud::intensities); },
          "(n,) float32 as the sensor gives them, or None.")
      .def_prop_ro(
          "T_cloud_sensor",
          [](const Scan& scan) -> std::optional<PoseArray> {
            if (!scan.T_cloud_sensor) return std::nullopt;
            return array_of(*scan.T_cloud_sensor);
          },
          nb::rv_policy::automatic, "(4, 4) where the sensor sits in the frame of the points, or None: at its origin.")
      .def("__len__", [](const Scan& scan) { return scan.cloud.size(); })
      .def("__repr__", &scan_text);
}

}  // namespace tilth::python
