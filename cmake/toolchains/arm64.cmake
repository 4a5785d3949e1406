# Cross-compiles for 64-bit Arm on Debian: TILTH_SYSROOT (variable or environment) is a folder that holds its packages
# (scripts/cross_arm64 makes one). Tests run under qemu's user emulation.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
if(NOT TILTH_SYSROOT)
  set(TILTH_SYSROOT $ENV{TILTH_SYSROOT})
endif()
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES TILTH_SYSROOT)
set(libraries ${TILTH_SYSROOT}/usr/lib/aarch64-linux-gnu)

set(CMAKE_SYSROOT ${TILTH_SYSROOT})
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH ${TILTH_SYSROOT})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${TILTH_SYSROOT})
set(ENV{PKG_CONFIG_LIBDIR} ${libraries}/pkgconfig:${TILTH_SYSROOT}/usr/share/pkgconfig)

# BLAS and LAPACK stand in folders of their own, of which Debian's alternatives choose when a package is set up.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-Wl,-rpath-link,${libraries}/blas:${libraries}/lapack")
set(CMAKE_SHARED_LINKER_FLAGS_INIT ${CMAKE_EXE_LINKER_FLAGS_INIT})
set(CMAKE_CROSSCOMPILING_EMULATOR
    "qemu-aarch64;-L;${TILTH_SYSROOT};-E;LD_LIBRARY_PATH=${libraries}/blas:${libraries}/lapack")
