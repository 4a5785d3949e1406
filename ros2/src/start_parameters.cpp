#include "start_parameters.hpp"

#include <memory>
#include <rcl/arguments.h>
#include <rcl_yaml_param_parser/parser.h>
#include <regex>

#include <tilth/core/error.hpp>
#include <tilth/node/parameter_value.hpp>

namespace tilth::ros2 {
namespace {

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
  if (const auto sim_time = start.values.extract("use_sim_time")) start.use_sim_time = sim_time.mapped() == "true";
  return start;
}

}  // namespace tilth::ros2
