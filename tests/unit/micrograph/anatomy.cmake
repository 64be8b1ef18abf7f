mpm_unit_test(anatomy_test SOURCES ${CMAKE_CURRENT_LIST_DIR}/anatomy_file_test.cpp
                                   ${CMAKE_CURRENT_LIST_DIR}/anatomy_test.cpp
                           LIBRARIES mpm_anatomy)
target_compile_definitions(anatomy_test PRIVATE
  MPM_INPUTS_DIR="${PROJECT_SOURCE_DIR}/inputs" MPM_DOCS_DIR="${PROJECT_SOURCE_DIR}/docs")
