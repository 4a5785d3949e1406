// How many threads this process may use.
#pragma once

#include <cstddef>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace tilth::app {

/// Calls f with at most `threads` threads, also where that is more than there are processors; 0: as many as there are.
template <class F>
auto with_threads(int threads, const F& f) {
  if (threads == 0) return f();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
  tbb::task_arena arena(threads);
  return arena.execute(f);
}

}  // namespace tilth::app
