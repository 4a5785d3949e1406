// Parameters of a node as middlewares know them: typed, with bounds. OptionInfo has them as text.
#pragma once

#include <cstdint>
#include <string>

#include <tilth/node/node_options.hpp>

namespace tilth {

enum class ParameterType : std::uint8_t { flag, integer, number, text };
ParameterType type_of(const NodeParameter& parameter);

/// Of a number. Throws Error, naming the key, where the option is none.
Bounds bounds_of(const OptionInfo& option);
double number_of(const OptionInfo& option);

/// As options are written: whole numbers without a point.
std::string parameter_text(double value);

}  // namespace tilth
