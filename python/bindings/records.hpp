// Records of a run as Python reads them.
#pragma once

#include <nanobind/nanobind.h>
#include <string>

#include "arrays.hpp"
#include <tilth/core/point_records.hpp>
#include <tilth/run/run_record.hpp>

namespace tilth::python {

namespace nb = nanobind;

/// A structured array of numpy whose elements are the records, fields at their offsets; it keeps their bytes.
nb::object structured_array(PointRecords records);

/// The records of a structured array, or of one with a single type where `name` stands for what it is. Throws Error on
/// a field of another type than numbers.
PointRecords records_of(nb::handle array, const std::string& name);

/// (n, 4) float32 x y z [m] intensity, in the world frame.
MapArray map_array(const MapBuilder& map);

using NamedValues = nb::typed<nb::dict, nb::str, nb::any>;
using NamedValuesList = nb::typed<nb::list, NamedValues>;

/// One dict a pair of keyframes that was looked at.
NamedValuesList closures_list(const LoopRecord& loops);

}  // namespace tilth::python
