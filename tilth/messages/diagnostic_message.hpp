// diagnostic_msgs/DiagnosticArray: the state of a program, with its figures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <tilth/messages/ros_message.hpp>

namespace tilth {

enum class DiagnosticLevel : std::uint8_t { ok, warn, error };

struct Diagnostic {
  double stamp = 0.0;  ///< [s]
  DiagnosticLevel level = DiagnosticLevel::ok;
  std::string name, message;
  std::vector<std::pair<std::string, std::string>> values;
};

/// An array of this one. Throws Error where the stamp lies outside [0, 2^32 - 1) s.
std::vector<std::byte> serialize_diagnostic(const Diagnostic& diagnostic,
                                            Serialization serialization = Serialization::cdr);

}  // namespace tilth
