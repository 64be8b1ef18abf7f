# The generator draws the same bytes on every machine: no fused multiply-add, no vector units of
# this one, hence not the flags of the other libraries.
set(anatomy_folder ${CMAKE_CURRENT_LIST_DIR})
add_library(mpm_anatomy STATIC
  ${anatomy_folder}/anatomy_cells.cpp ${anatomy_folder}/anatomy_drawing.cpp
  ${anatomy_folder}/anatomy_file.cpp ${anatomy_folder}/anatomy_keys.cpp
  ${anatomy_folder}/anatomy_parameters.cpp
  ${anatomy_folder}/anatomy_tissue.cpp ${anatomy_folder}/picture_file.cpp)
target_include_directories(mpm_anatomy PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>)
target_include_directories(mpm_anatomy SYSTEM PRIVATE ${STB_INCLUDE_DIR})
target_compile_options(mpm_anatomy PRIVATE -Wall -Wextra -ffp-contract=off -fno-fast-math)
target_link_libraries(mpm_anatomy PUBLIC mpm_core PRIVATE yaml-cpp::yaml-cpp fmt::fmt)
mpm_installed(mpm_anatomy)

add_executable(draw_wood ${anatomy_folder}/draw_wood.cpp)
target_compile_options(draw_wood PRIVATE -Wall -Wextra)
target_link_libraries(draw_wood PRIVATE mpm_anatomy CLI11::CLI11 fmt::fmt)
