// The one parallel loop: fixed chunks and ordered sums, so that results have the same bits for any number of threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>

namespace tilth {

/// Calls f(begin, end) on consecutive chunks of [0, n), each of `chunk` indices but the last; chunks may run at once.
template <class F>
void parallel_for(std::size_t n, std::size_t chunk, const F& f) {
  const std::size_t chunks = (n + chunk - 1) / chunk;
  if (chunks == 1) return f(std::size_t{0}, n);
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) { f(c * chunk, std::min(n, (c + 1) * chunk)); });
}

/// Sum over chunks of f(begin, end), added in the order of the chunks. T() must be the zero of the sum.
template <class T, class F>
T parallel_sum(std::size_t n, std::size_t chunk, const F& f) {
  std::vector<T> parts((n + chunk - 1) / chunk, T());
  parallel_for(n, chunk, [&](std::size_t begin, std::size_t end) { parts[begin / chunk] = f(begin, end); });
  T sum = T();
  for (const T& part : parts) sum += part;
  return sum;
}

}  // namespace tilth
