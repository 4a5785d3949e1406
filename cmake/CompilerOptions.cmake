# Warnings for our own code only; errors where TILTH_WERROR is set (CI does).
add_library(tilth_warnings INTERFACE)
target_compile_options(
  tilth_warnings
  INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align -Wunused
            $<$<BOOL:${TILTH_WERROR}>:-Werror> -ffp-contract=off)

find_program(TILTH_CCACHE ccache)
if(TILTH_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${TILTH_CCACHE})
endif()

if(TILTH_SANITIZE)
  add_compile_options(-fsanitize=${TILTH_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${TILTH_SANITIZE})
endif()
