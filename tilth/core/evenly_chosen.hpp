// Some of many, evenly over their order. O(chosen).
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace tilth {

/// Every how many-th of `size` items is taken so that at least `most` of them are, and less than twice as many.
inline std::size_t stride_of(std::size_t size, std::size_t most) {
  return std::max<std::size_t>(1, size / std::max<std::size_t>(1, most));
}

/// At most `most` of `items`: all of them where they are no more.
template <class T>
std::vector<T> evenly_chosen(std::span<const T> items, std::size_t most) {
  const std::size_t count = std::min(items.size(), most);
  std::vector<T> chosen;
  chosen.reserve(count);
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(items[i * items.size() / count]);
  return chosen;
}

}  // namespace tilth
