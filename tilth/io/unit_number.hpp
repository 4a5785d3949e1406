// Numbers of text files that count in another unit than the program: written so that they read back to the last bit.
#pragma once

#include <string>
#include <string_view>

namespace tilth {

/// What a number of a file counts in, and its greatest size there.
struct FileUnit {
  long double size;  ///< in the program's unit; long, so that degrees lose no bit
  double most;
  const char* name;
};

/// The number that reads back as `value`: six digits where they do, else as many as it takes.
std::string text_of(double value, const FileUnit& unit);

/// In the program's unit. Throws Error with `where` for what is no finite number, and for one beyond unit.most.
double number_of(std::string_view text, const FileUnit& unit, const std::string& where);

}  // namespace tilth
