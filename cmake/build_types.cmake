# Build types: Release (default), Developer (warnings as errors, assertions), Debug.
# Vector width: MPM_VECTOR.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Developer or Debug" FORCE)
endif()
set_property(CACHE CMAKE_BUILD_TYPE PROPERTY STRINGS Release Developer Debug)

set(MPM_VECTOR native CACHE STRING
    "Vector unit: native (this machine's), or of any x86-64: baseline, avx2, avx512 (2, 4, 8 doubles)")
set_property(CACHE MPM_VECTOR PROPERTY STRINGS native baseline avx2 avx512)

# The compiler's name for a vector unit; x86-64-v3 and -v4 are the sets of instructions that come
# with AVX2 and with AVX-512.
function(mpm_vector_flags vector result)
  set(native -march=native)
  set(baseline -march=x86-64)
  set(avx2 -march=x86-64-v3)
  set(avx512 -march=x86-64-v4)
  if(NOT vector MATCHES "^(native|baseline|avx2|avx512)$")
    message(FATAL_ERROR "MPM_VECTOR is '${vector}': give native, baseline, avx2 or avx512")
  endif()
  set(${result} ${${vector}} PARENT_SCOPE)
endfunction()
mpm_vector_flags("${MPM_VECTOR}" MPM_VECTOR_FLAGS)

# mpm_common_flags is for code of any width, mpm_flags for this build's.
add_library(mpm_common_flags INTERFACE)
# GCC 12 calls the undefined operands in its own AVX-512 headers uninitialised, and the concatenation
# of its own strings overlapping: none of these warnings.
# errno and floating-point traps are never looked at; NaN and infinity keep their meaning.
target_compile_options(mpm_common_flags INTERFACE
                       -Wall -Wextra -Wno-psabi -Wno-uninitialized
                       $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized$<SEMICOLON>-Wno-restrict>
                       -fno-math-errno -fno-trapping-math)

set(MPM_SANITIZE "" CACHE STRING
    "Sanitizers that watch over program and tests, such as address,undefined: for a build folder of its own")
if(MPM_SANITIZE)
  # Of the Release build's optimisation little is left: its vector code takes hours to instrument.
  target_compile_options(mpm_common_flags INTERFACE -fsanitize=${MPM_SANITIZE}
                         -fno-sanitize-recover=all -fno-omit-frame-pointer -g1 -O1 -UNDEBUG)
  target_link_options(mpm_common_flags INTERFACE -fsanitize=${MPM_SANITIZE})
endif()
option(MPM_BUILD_FUZZERS "Build libFuzzer's targets for the readers of scenes and images (needs Clang)"
       OFF)
set(MPM_FUZZ_SECONDS 60 CACHE STRING "Seconds that each of libFuzzer's tests looks for failures")
add_library(mpm_flags INTERFACE)
target_compile_options(mpm_flags INTERFACE ${MPM_VECTOR_FLAGS})
target_link_libraries(mpm_flags INTERFACE mpm_common_flags)
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEVELOPER "-O2 -g -Werror")
set(CMAKE_C_FLAGS_DEVELOPER "-O2 -g")
