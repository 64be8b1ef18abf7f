# Headers that nearly every file reads, compiled once. A file includes what it uses all the same: Developer
# builds, which do without, see what is missing. Fuzzers give flags of their own to some of the libraries.
if(CMAKE_BUILD_TYPE STREQUAL "Developer" OR MPM_BUILD_FUZZERS)
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

# mpm_common_headers(<target> LIBRARIES ... HEADERS ...): an object library whose headers others take by
# target_precompile_headers(<their target> REUSE_FROM <target>); these headers and some of the standard
# library. A definition in LIBRARIES has to be one of all who take them.
function(mpm_common_headers target)
  cmake_parse_arguments(common "" "" "LIBRARIES;HEADERS" ${ARGN})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "")
  add_library(${target} OBJECT ${source})
  target_link_libraries(${target} PRIVATE ${common_LIBRARIES} mpm_flags)
  target_precompile_headers(${target} PRIVATE ${common_HEADERS}
    <algorithm> <array> <cmath> <functional> <map> <memory> <optional> <span> <string> <string_view>
    <variant> <vector>)
endfunction()
