# Build types: Release (default; this machine's vector units, or baseline x86-64 with MPM_PORTABLE),
# Developer (warnings as errors, assertions), Debug.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Developer or Debug" FORCE)
endif()
set_property(CACHE CMAKE_BUILD_TYPE PROPERTY STRINGS Release Developer Debug)

option(MPM_PORTABLE "Build for baseline x86-64 instead of this machine's vector units" OFF)

add_library(mpm_flags INTERFACE)
# GCC 12 calls the undefined operands in its own AVX-512 headers uninitialised, and the concatenation
# of its own strings overlapping: none of these warnings.
# errno and floating-point traps are never looked at; NaN and infinity keep their meaning.
target_compile_options(mpm_flags INTERFACE -Wall -Wextra -Wno-psabi -Wno-uninitialized
                                           -Wno-maybe-uninitialized -Wno-restrict -fno-math-errno
                                           -fno-trapping-math)
if(NOT MPM_PORTABLE)
  target_compile_options(mpm_flags INTERFACE -march=native)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEVELOPER "-O2 -g -Werror")
set(CMAKE_C_FLAGS_DEVELOPER "-O2 -g")
