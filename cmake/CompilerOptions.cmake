# Warnings for our own code only; errors where TILTH_WERROR is set (CI does). Square roots of negative numbers set no errno,
# and comparisons no flags, that anybody reads: loops with them vectorise.
add_library(tilth_warnings INTERFACE)
target_compile_options(
  tilth_warnings
  INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align -Wunused
            $<$<BOOL:${TILTH_WERROR}>:-Werror> -ffp-contract=off -fno-math-errno -fno-trapping-math
            $<$<BOOL:${TILTH_PRECOMPILED_HEADERS}>:-fpch-preprocess>) # ccache asks for it

# Appended where no figure depends on the speed: in tests, and in rooms that no point of a scan passes through.
set(TILTH_QUICKLY_COMPILED $<$<CONFIG:Release>:-O1>)

# Of x86's instruction sets the baseline, AVX2 and AVX-512 are compiled, those between them gain nothing here; of Arm's NEON,
# as vectors whose length is not known when they are compiled (SVE) cannot be kept in structs.
set(TILTH_INSTRUCTION_SETS
    "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SSE4|HWY_AVX3_DL|HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)")

find_program(TILTH_CCACHE ccache)
if(TILTH_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${TILTH_CCACHE})
endif()

if(TILTH_SANITIZE)
  add_compile_options(-fsanitize=${TILTH_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  if(TILTH_SANITIZE_WITHOUT)
    add_compile_options(-fno-sanitize=${TILTH_SANITIZE_WITHOUT})
  endif()
  add_link_options(-fsanitize=${TILTH_SANITIZE})
endif()
