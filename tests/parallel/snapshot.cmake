# Snapshots written by 1, 2 and 3 ranks, and the series of 2 ranks read back through ParaView.
mpm_parallel_test(snapshot_test RANKS 1 2 3 SOURCES ${CMAKE_CURRENT_LIST_DIR}/snapshot_test.cpp
                  LIBRARIES mpm_output mpm_core nlohmann_json::nlohmann_json ${HDF5_C_LIBRARIES})
target_include_directories(snapshot_test PRIVATE ${HDF5_C_INCLUDE_DIRS})
target_compile_definitions(snapshot_test PRIVATE
                           MPM_SCRATCH_DIRECTORY="${CMAKE_BINARY_DIR}/snapshot_test_files")

mpm_parallel_test(state_file_test RANKS 1 2 3 SOURCES ${CMAKE_CURRENT_LIST_DIR}/state_file_test.cpp
                  LIBRARIES mpm_output mpm_core)
target_compile_definitions(state_file_test PRIVATE
                           MPM_SCRATCH_DIRECTORY="${CMAKE_BINARY_DIR}/state_file_test_files")

set(series ${CMAKE_BINARY_DIR}/snapshot_test_files/for_paraview)
add_test(NAME paraview_series_is_written
         COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} 2 ${MPIEXEC_PREFLAGS}
                 $<TARGET_FILE:snapshot_test> --gtest_filter=SnapshotSeries.ForParaView*)
set_tests_properties(paraview_series_is_written PROPERTIES
  FIXTURES_SETUP paraview_series LABELS regression PROCESSORS 2
  ENVIRONMENT "MPM_SERIES_DIRECTORY=${series};${MPM_MPI_ENVIRONMENT}")

find_program(PVPYTHON_EXECUTABLE pvpython)
if(PVPYTHON_EXECUTABLE)
  add_test(NAME paraview_reads_series
           COMMAND ${PVPYTHON_EXECUTABLE} ${CMAKE_CURRENT_LIST_DIR}/../support/read_xdmf.py
                   ${series}/particles.xdmf --expect ${series}/expected.json)
else()
  add_test(NAME paraview_reads_series COMMAND ${CMAKE_COMMAND} -E echo
           "skipped: pvpython is not installed (Debian: python3-paraview)")
endif()
set_tests_properties(paraview_reads_series PROPERTIES
  FIXTURES_REQUIRED paraview_series LABELS regression SKIP_REGULAR_EXPRESSION "^skipped:")
