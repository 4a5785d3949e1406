#include "parameters.hpp"

#include <algorithm>
#include <rcl/arguments.h>
#include <rcl_interfaces/msg/floating_point_range.h>
#include <rcl_interfaces/msg/parameter_descriptor.h>
#include <rcl_interfaces/msg/parameter_type.h>
#include <rcl_interfaces/msg/parameter_value.h>
#include <rcl_interfaces/msg/set_parameters_result.h>
#include <rcl_interfaces/srv/describe_parameters.h>
#include <rcl_interfaces/srv/get_parameter_types.h>
#include <rcl_interfaces/srv/get_parameters.h>
#include <rcl_interfaces/srv/list_parameters.h>
#include <rcl_interfaces/srv/set_parameters.h>
#include <rcl_yaml_param_parser/parser.h>
#include <regex>
#include <rosidl_runtime_c/primitives_sequence_functions.h>

#include <tilth/core/error.hpp>
#include <tilth/node/parameter_value.hpp>

namespace tilth::ros2 {
namespace {

TILTH_ROS2_SERVICE(rcl_interfaces, DescribeParameters);
TILTH_ROS2_SERVICE(rcl_interfaces, GetParameterTypes);
TILTH_ROS2_SERVICE(rcl_interfaces, GetParameters);
TILTH_ROS2_SERVICE(rcl_interfaces, ListParameters);
TILTH_ROS2_SERVICE(rcl_interfaces, SetParameters);

constexpr const char* kSimTime = "use_sim_time";

/// Whether a node named by `pattern` in a parameter file is this one: * stands for one part of its name, ** for any.
bool is_meant(const std::string& pattern, const std::string& node) {
  std::string expression = pattern.starts_with('/') ? pattern : "/" + pattern;
  expression = std::regex_replace(expression, std::regex(R"(/\*\*)"), "(/\\w+)+");
  expression = std::regex_replace(expression, std::regex(R"(/\*)"), "(/\\w+)");
  return std::regex_match(node, std::regex(expression));
}

std::string text_of(const std::string& key, const rcl_variant_t& value) {
  if (value.bool_value != nullptr) return *value.bool_value ? "true" : "false";
  if (value.integer_value != nullptr) return std::to_string(*value.integer_value);
  if (value.double_value != nullptr) return parameter_text(*value.double_value);
  if (value.string_value != nullptr) return value.string_value;
  throw Error("parameter " + key, "is a list: expected one value");
}

std::uint8_t kind_of(const OptionInfo& option) {
  switch (type_of(option)) {
    case ParameterType::flag: return rcl_interfaces__msg__ParameterType__PARAMETER_BOOL;
    case ParameterType::number: return rcl_interfaces__msg__ParameterType__PARAMETER_DOUBLE;
    case ParameterType::text: break;
  }
  return rcl_interfaces__msg__ParameterType__PARAMETER_STRING;
}

void describe(const OptionInfo& option, rcl_interfaces__msg__ParameterDescriptor& to) {
  to.type = kind_of(option);
  to.read_only = true;
  assign(to.name, option.key);
  assign(to.description, "[" + option.unit + "] " + option.meaning);
  assign(to.additional_constraints, option.allowed);
  if (type_of(option) != ParameterType::number) return;
  const Bounds bounds = bounds_of(option);
  rcl_interfaces__msg__FloatingPointRange__Sequence__init(&to.floating_point_range, 1);
  to.floating_point_range.data[0].from_value = bounds.min;
  to.floating_point_range.data[0].to_value = bounds.max;
}

void set_value(const OptionInfo& option, rcl_interfaces__msg__ParameterValue& to) {
  to.type = kind_of(option);
  switch (type_of(option)) {
    case ParameterType::flag: to.bool_value = option.value == "true"; break;
    case ParameterType::number: to.double_value = number_of(option); break;
    case ParameterType::text: assign(to.string_value, option.value); break;
  }
}

/// Calls `answer` with each of `parameters` that is asked for, and its place among those names.
template <class F>
void for_each_known(const std::vector<OptionInfo>& parameters, const rosidl_runtime_c__String__Sequence& names,
                    const F& answer) {
  for (std::size_t i = 0; i < names.size; ++i) {
    const auto is_it = [&](const OptionInfo& option) { return option.key == names.data[i].data; };
    const auto found = std::find_if(parameters.begin(), parameters.end(), is_it);
    if (found != parameters.end()) answer(*found, i);
  }
}

}  // namespace

StartParameters read_parameters(RclNode& node) {
  StartParameters start;
  rcl_params_t* overrides = nullptr;
  check(rcl_arguments_get_param_overrides(&node.context()->global_arguments, &overrides), "parameters");
  if (overrides == nullptr) return start;
  const std::unique_ptr<rcl_params_t, void (*)(rcl_params_t*)> kept(overrides, rcl_yaml_node_struct_fini);
  for (std::size_t n = 0; n < overrides->num_nodes; ++n) {
    if (!is_meant(overrides->node_names[n], node.name())) continue;
    const rcl_node_params_t& own = overrides->params[n];
    for (std::size_t i = 0; i < own.num_params; ++i)
      start.values[own.parameter_names[i]] = text_of(own.parameter_names[i], own.parameter_values[i]);
  }
  if (const auto sim_time = start.values.extract(kSimTime)) start.use_sim_time = sim_time.mapped() == "true";
  return start;
}

std::vector<std::unique_ptr<ServiceServer>> parameter_services(RclNode& node, std::vector<OptionInfo> known,
                                                               bool use_sim_time) {
  known.push_back({kSimTime, use_sim_time ? "true" : "false", "-", "time is that of /clock", "true | false"});
  std::vector<std::unique_ptr<ServiceServer>> services;
  const auto add = [&]<class S>(const char* name, S, auto handler) {
    services.push_back(std::make_unique<TypedService<S>>(node, name, std::move(handler)));
  };
  add("~/list_parameters", ListParametersService{}, [known](const auto&, auto& response) {
    rosidl_runtime_c__String__Sequence__init(&response.result.names, known.size());
    for (std::size_t i = 0; i < known.size(); ++i) assign(response.result.names.data[i], known[i].key);
  });
  add("~/describe_parameters", DescribeParametersService{}, [known](const auto& request, auto& response) {
    rcl_interfaces__msg__ParameterDescriptor__Sequence__init(&response.descriptors, request.names.size);
    for_each_known(known, request.names, [&](const auto& o, auto i) { describe(o, response.descriptors.data[i]); });
  });
  add("~/get_parameters", GetParametersService{}, [known](const auto& request, auto& response) {
    rcl_interfaces__msg__ParameterValue__Sequence__init(&response.values, request.names.size);
    for_each_known(known, request.names, [&](const auto& o, auto i) { set_value(o, response.values.data[i]); });
  });
  add("~/get_parameter_types", GetParameterTypesService{}, [known](const auto& request, auto& response) {
    rosidl_runtime_c__uint8__Sequence__init(&response.types, request.names.size);
    for_each_known(known, request.names, [&](const auto& o, auto i) { response.types.data[i] = kind_of(o); });
  });
  add("~/set_parameters", SetParametersService{}, [](const auto& request, auto& response) {
    rcl_interfaces__msg__SetParametersResult__Sequence__init(&response.results, request.parameters.size);
    for (std::size_t i = 0; i < request.parameters.size; ++i)
      assign(response.results.data[i].reason, "parameters are read when the node starts");
  });
  return services;
}

}  // namespace tilth::ros2
