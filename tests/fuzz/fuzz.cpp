// One program a target (TILTH_FUZZ_TARGET) for libFuzzer: fuzz_<target> CORPUS tests/fuzz/seeds/<target>
#include <algorithm>
#include <cstdint>

#include "targets.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto target = std::find_if(tilth::fuzz::kTargets.begin(), tilth::fuzz::kTargets.end(),
                                          [](const auto& t) { return t.name == TILTH_FUZZ_TARGET; });
  tilth::fuzz::run(*target, std::as_bytes(std::span(data, size)));
  return 0;
}
