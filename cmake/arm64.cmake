# Toolchain file: Debian's cross compiler for arm64, and a sysroot of Debian's arm64 packages, made by scripts/build_arm64.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_CXX_FLAGS_INIT -Wno-psabi)  # that GCC 10 passes some arguments unlike GCC 9 concerns nobody here
if(NOT DEFINED ENV{MOCHA_SYSROOT})
  message(FATAL_ERROR "MOCHA_SYSROOT names no sysroot of arm64 packages: call scripts/build_arm64")
endif()
set(CMAKE_SYSROOT $ENV{MOCHA_SYSROOT})

# What runs while building, as lcm-gen and the message generators, is this machine's; what is compiled in or linked is the robot's,
# or was made by this build.
set(CMAKE_FIND_ROOT_PATH ${CMAKE_BINARY_DIR})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
