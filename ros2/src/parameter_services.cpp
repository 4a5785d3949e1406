#include "parameter_services.hpp"

#include <algorithm>
#include <rcl_interfaces/msg/floating_point_range.h>
#include <rcl_interfaces/msg/integer_range.h>
#include <rcl_interfaces/msg/parameter_descriptor.h>
#include <rcl_interfaces/msg/parameter_type.h>
#include <rcl_interfaces/msg/parameter_value.h>
#include <rcl_interfaces/msg/set_parameters_result.h>
#include <rcl_interfaces/srv/describe_parameters.h>
#include <rcl_interfaces/srv/get_parameter_types.h>
#include <rcl_interfaces/srv/get_parameters.h>
#include <rcl_interfaces/srv/list_parameters.h>
#include <rcl_interfaces/srv/set_parameters.h>
#include <rcl_interfaces/srv/set_parameters_atomically.h>
#include <rosidl_runtime_c/primitives_sequence_functions.h>

#include <tilth/core/error.hpp>
#include <tilth/node/parameter_value.hpp>

namespace tilth::ros2 {
namespace {

constexpr const char* kSimTime = "use_sim_time";

TILTH_ROS2_SERVICE(rcl_interfaces, DescribeParameters);
TILTH_ROS2_SERVICE(rcl_interfaces, GetParameterTypes);
TILTH_ROS2_SERVICE(rcl_interfaces, GetParameters);
TILTH_ROS2_SERVICE(rcl_interfaces, ListParameters);
TILTH_ROS2_SERVICE(rcl_interfaces, SetParameters);
TILTH_ROS2_SERVICE(rcl_interfaces, SetParametersAtomically);

std::string text_of(const std::string& key, const rcl_interfaces__msg__ParameterValue& value) {
  switch (value.type) {
    case rcl_interfaces__msg__ParameterType__PARAMETER_BOOL: return value.bool_value ? "true" : "false";
    case rcl_interfaces__msg__ParameterType__PARAMETER_INTEGER: return std::to_string(value.integer_value);
    case rcl_interfaces__msg__ParameterType__PARAMETER_DOUBLE: return parameter_text(value.double_value);
    case rcl_interfaces__msg__ParameterType__PARAMETER_STRING: return value.string_value.data;
    default: throw Error("parameter " + key, "is no value, or a list: expected one value");
  }
}

std::uint8_t kind_of(const NodeParameter& parameter) {
  switch (type_of(parameter)) {
    case ParameterType::flag: return rcl_interfaces__msg__ParameterType__PARAMETER_BOOL;
    case ParameterType::integer: return rcl_interfaces__msg__ParameterType__PARAMETER_INTEGER;
    case ParameterType::number: return rcl_interfaces__msg__ParameterType__PARAMETER_DOUBLE;
    case ParameterType::text: break;
  }
  return rcl_interfaces__msg__ParameterType__PARAMETER_STRING;
}

/// A bound as far as integers reach.
std::int64_t whole_bound(double bound) {
  constexpr double kMost = 9007199254740992.0;  // 2^53: whole numbers beyond are not told apart
  return std::int64_t(std::clamp(bound, -kMost, kMost));
}

void describe(const NodeParameter& parameter, rcl_interfaces__msg__ParameterDescriptor& to) {
  to.type = kind_of(parameter);
  to.read_only = !parameter.running;
  assign(to.name, parameter.key);
  assign(to.description, "[" + parameter.unit + "] " + parameter.meaning);
  assign(to.additional_constraints, parameter.allowed);
  if (type_of(parameter) == ParameterType::number) {
    const Bounds bounds = bounds_of(parameter);
    rcl_interfaces__msg__FloatingPointRange__Sequence__init(&to.floating_point_range, 1);
    to.floating_point_range.data[0].from_value = bounds.min;
    to.floating_point_range.data[0].to_value = bounds.max;
  } else if (type_of(parameter) == ParameterType::integer) {
    const Bounds bounds = bounds_of(parameter);
    rcl_interfaces__msg__IntegerRange__Sequence__init(&to.integer_range, 1);
    to.integer_range.data[0].from_value = whole_bound(bounds.min);
    to.integer_range.data[0].to_value = whole_bound(bounds.max);
  }
}

void set_value(const NodeParameter& parameter, rcl_interfaces__msg__ParameterValue& to) {
  to.type = kind_of(parameter);
  switch (type_of(parameter)) {
    case ParameterType::flag: to.bool_value = parameter.value == "true"; break;
    case ParameterType::integer: to.integer_value = std::int64_t(number_of(parameter)); break;
    case ParameterType::number: to.double_value = number_of(parameter); break;
    case ParameterType::text: assign(to.string_value, parameter.value); break;
  }
}

/// What the services are asked about.
class AskedParameters {
 public:
  AskedParameters(SlamNode& slam, bool use_sim_time) : slam_(slam), use_sim_time_(use_sim_time) {}

  std::vector<NodeParameter> all() const {
    std::vector<NodeParameter> all = slam_.parameters();
    all.push_back({{kSimTime, use_sim_time_ ? "true" : "false", "-", "time is that of /clock", "true | false"}});
    return all;
  }

  /// Calls `answer` with each that is asked for, and its place among those names.
  template <class F>
  void for_each(const rosidl_runtime_c__String__Sequence& names, const F& answer) const {
    const std::vector<NodeParameter> known = all();
    for (std::size_t i = 0; i < names.size; ++i) {
      const auto is_it = [&](const NodeParameter& parameter) { return parameter.key == names.data[i].data; };
      const auto found = std::find_if(known.begin(), known.end(), is_it);
      if (found != known.end()) answer(*found, i);
    }
  }

  /// Sets some, all or none.
  void set(std::span<const rcl_interfaces__msg__Parameter> some, rcl_interfaces__msg__SetParametersResult& to) const {
    try {
      OptionValues values;
      for (const rcl_interfaces__msg__Parameter& one : some) values[one.name.data] = text_of(one.name.data, one.value);
      if (values.contains(kSimTime)) throw Error(kSimTime, "is read when the node starts");
      const SlamNode::Answer answer = slam_.set(values);
      to.successful = answer.success;
      assign(to.reason, answer.message);
    } catch (const Error& error) {
      assign(to.reason, error.what());
    }
  }

 private:
  SlamNode& slam_;
  bool use_sim_time_;
};

}  // namespace

std::vector<std::unique_ptr<ServiceServer>> parameter_services(RclNode& node, SlamNode& slam, bool use_sim_time) {
  const AskedParameters asked(slam, use_sim_time);
  std::vector<std::unique_ptr<ServiceServer>> services;
  const auto add = [&]<class S>(const char* name, S, auto handler) {
    services.push_back(std::make_unique<TypedService<S>>(node, name, std::move(handler)));
  };
  add("~/list_parameters", ListParametersService{}, [asked](const auto&, auto& response) {
    const std::vector<NodeParameter> all = asked.all();
    rosidl_runtime_c__String__Sequence__init(&response.result.names, all.size());
    for (std::size_t i = 0; i < all.size(); ++i) assign(response.result.names.data[i], all[i].key);
  });
  add("~/describe_parameters", DescribeParametersService{}, [asked](const auto& request, auto& response) {
    rcl_interfaces__msg__ParameterDescriptor__Sequence__init(&response.descriptors, request.names.size);
    asked.for_each(request.names, [&](const auto& p, auto i) { describe(p, response.descriptors.data[i]); });
  });
  add("~/get_parameters", GetParametersService{}, [asked](const auto& request, auto& response) {
    rcl_interfaces__msg__ParameterValue__Sequence__init(&response.values, request.names.size);
    asked.for_each(request.names, [&](const auto& p, auto i) { set_value(p, response.values.data[i]); });
  });
  add("~/get_parameter_types", GetParameterTypesService{}, [asked](const auto& request, auto& response) {
    rosidl_runtime_c__uint8__Sequence__init(&response.types, request.names.size);
    asked.for_each(request.names, [&](const auto& p, auto i) { response.types.data[i] = kind_of(p); });
  });
  add("~/set_parameters", SetParametersService{}, [asked](const auto& request, auto& response) {
    rcl_interfaces__msg__SetParametersResult__Sequence__init(&response.results, request.parameters.size);
    for (std::size_t i = 0; i < request.parameters.size; ++i)
      asked.set({request.parameters.data + i, 1}, response.results.data[i]);
  });
  add("~/set_parameters_atomically", SetParametersAtomicallyService{}, [asked](const auto& request, auto& response) {
    asked.set({request.parameters.data, request.parameters.size}, response.result);
  });
  return services;
}

}  // namespace tilth::ros2
