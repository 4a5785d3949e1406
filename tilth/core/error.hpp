// The one exception of the house: bad input, named so that a user can mend it.
#pragma once

#include <stdexcept>
#include <string>

namespace tilth {

/// Bad input. `where` names the file, option or field; `what` says what is wrong with it and which bound it breaks.
struct Error : std::runtime_error {
  Error(const std::string& where, const std::string& what) : std::runtime_error(where + ": " + what) {}
};

}  // namespace tilth
