// Files of clouds and of poses.
#include <functional>
#include <map>
#include <nanobind/stl/string.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "records.hpp"
#include <tilth/io/kitti_bin.hpp>
#include <tilth/io/las.hpp>
#include <tilth/io/pcd.hpp>
#include <tilth/io/ply.hpp>
#include <tilth/io/trajectory_file.hpp>

namespace tilth::python {
namespace {

template <class Read>
auto reader(const Read& read) {
  return [read](const std::string& path) {
    PointRecords records;
    {
      const nb::gil_scoped_release unlocked;
      records = read(path);
    }
    return structured_array(std::move(records));
  };
}

template <class Write>
auto writer(const Write& write) {
  return [write](const std::string& path, nb::handle array) { write(path, records_of(array, "records")); };
}

}  // namespace

void add_files(nb::module_& module) {
  module.def("read_pcd", reader([](const std::string& path) { return read_pcd(path); }),
             nb::sig("def read_pcd(path: str, /) -> numpy.typing.NDArray[numpy.void]"));
  module.def("read_ply", reader([](const std::string& path) { return read_ply(path); }),
             nb::sig("def read_ply(path: str, /) -> numpy.typing.NDArray[numpy.void]"));
  module.def("read_bin", reader([](const std::string& path) { return read_kitti_bin(path); }),
             nb::sig("def read_bin(path: str, /) -> numpy.typing.NDArray[numpy.void]"));
  module.def("write_pcd", writer([](const std::string& path, const PointRecords& r) { write_pcd(path, r); }));
  module.def("write_ply", writer([](const std::string& path, const PointRecords& r) { write_ply(path, r); }));
  module.def("write_bin", writer([](const std::string& path, const PointRecords& r) { write_kitti_bin(path, r); }));
  module.def("write_las", writer([](const std::string& path, const PointRecords& r) { write_las(path, r); }));
  module.def("write_tum", [](const std::string& path, nb::handle stamps, nb::handle poses) {
    write_tum(path, trajectory_of(stamps, poses, "trajectory"));
  });
  module.def("write_kitti", [](const std::string& path, nb::handle stamps, nb::handle poses) {
    write_kitti_poses(path, trajectory_of(stamps, poses, "trajectory"));
  });
}

}  // namespace tilth::python
