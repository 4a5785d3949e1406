#include "records.hpp"

#include <array>
#include <cstring>
#include <utility>

#include <tilth/core/error.hpp>

namespace tilth::python {
namespace {

constexpr std::array<const char*, 10> kTypes{"i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"};

FieldType type_of(nb::handle dtype, const std::string& field) {
  const std::string code =
      std::string(nb::str(dtype.attr("kind")).c_str()) + std::to_string(nb::cast<std::size_t>(dtype.attr("itemsize")));
  for (std::size_t i = 0; i < kTypes.size(); ++i) {
    if (code == kTypes[i]) return FieldType(i);
  }
  throw Error("field " + field, std::string("has the type ") + nb::str(dtype).c_str() +
                                    ", expected integers or floats of at most 64 bits");
}

nb::object dtype_of(const PointRecords& records) {
  const std::string order = records.byte_order == std::endian::big ? ">" : "<";
  nb::list names, formats, offsets;
  for (const PointField& field : records.fields) {
    names.append(field.name);
    formats.append(order + kTypes[std::size_t(field.type)]);
    offsets.append(field.offset);
  }
  nb::dict layout;
  layout["names"] = names, layout["formats"] = formats, layout["offsets"] = offsets;
  layout["itemsize"] = records.stride;
  return nb::module_::import_("numpy").attr("dtype")(layout);
}

nb::dict closure_dict(const ClosureRow& row) {
  nb::dict closure;
  closure["from_scan"] = row.from_scan, closure["to_scan"] = row.to_scan;
  closure["from_stamp"] = row.from_stamp, closure["to_stamp"] = row.to_stamp;
  closure["T_from_to"] = array_of(row.constraint.T_from_to);
  closure["found_by"] = nb::str(row.found_by.c_str()), closure["verdict"] = nb::str(row.verdict.c_str());
  closure["accepted"] = row.verdict == "accepted";
  closure["overlap"] = row.overlap, closure["back_overlap"] = row.back_overlap;
  closure["landmarks"] = row.landmarks, closure["fitness"] = row.fitness;
  closure["degenerate_directions"] = row.degenerate_directions;
  closure["squared_error"] = row.squared_error;
  return closure;
}

}  // namespace

nb::object structured_array(PointRecords records) {
  const nb::object dtype = dtype_of(records);
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(records.bytes.data());
  const std::vector<std::uint8_t> plain(bytes, bytes + records.stride * records.count);
  return nb::cast(column_array(plain)).attr("view")(dtype);
}

PointRecords records_of(nb::handle object, const std::string& name) {
  const nb::module_ numpy = nb::module_::import_("numpy");
  const nb::object array = numpy.attr("ascontiguousarray")(object);
  const nb::object dtype = array.attr("dtype");
  if (dtype.attr("names").is_none() || nb::cast<int>(array.attr("ndim")) != 1)
    throw Error(name, "is no structured array of one dimension with fields such as x, y, z");
  PointRecords records;
  records.stride = nb::cast<std::size_t>(dtype.attr("itemsize"));
  records.count = nb::cast<std::size_t>(array.attr("size"));
  for (const nb::handle field : dtype.attr("names")) {
    const auto text = nb::cast<std::string>(field);
    const nb::object entry = dtype.attr("fields")[field];
    if (!nb::cast<bool>(entry[0].attr("isnative")))
      throw Error("field " + text, "has its bytes in the other order: expected those of this machine");
    records.fields.push_back({text, type_of(entry[0], text), nb::cast<std::size_t>(entry[1])});
  }
  const auto bytes = nb::cast<nb::bytes>(array.attr("tobytes")());
  records.bytes.resize(bytes.size());
  std::memcpy(records.bytes.data(), bytes.c_str(), bytes.size());
  return records;
}

MapArray map_array(const MapBuilder& map) {
  std::vector<float> values;
  values.reserve(4 * map.size());
  for (const MapPoint& p : map.points()) values.insert(values.end(), {p.x, p.y, p.z, p.intensity});
  return owned_array<MapArray>(std::move(values), {map.size(), 4});
}

NamedValuesList closures_list(const LoopRecord& loops) {
  nb::list list;
  for (const ClosureRow& row : loops.closures) list.append(closure_dict(row));
  return nb::borrow<NamedValuesList>(list);
}

}  // namespace tilth::python
