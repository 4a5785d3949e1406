// The names of enums as text.
#pragma once

#include <string>

namespace tilth::python {

template <class E>
std::string name_of(E value) {
  return std::string(names_of(value)[std::size_t(value)]);
}

}  // namespace tilth::python
