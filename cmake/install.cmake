# What `cmake --install` puts where. The prefix may be moved afterwards: nothing in it names itself.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(MPM_CMAKE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/mpm_par)
set(MPM_DATA_FOLDER ${CMAKE_INSTALL_DATADIR}/mpm_par)
set(MPM_DOC_FOLDER ${CMAKE_INSTALL_DATADIR}/doc/mpm-par)
# Libraries of modules, which the loader would not find.
set(CMAKE_INSTALL_RPATH_USE_LINK_PATH TRUE)

# A macro, since exported targets are those of the folder that asks for them.
macro(mpm_install)
  install(TARGETS mpm_par mpm_curve draw_wood RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

  # Headers and libraries agree on the width of vectors: whoever uses them compiles for the same.
  target_compile_options(mpm_core INTERFACE "$<INSTALL_INTERFACE:${MPM_VECTOR_FLAGS}>")
  target_compile_features(mpm_core PUBLIC cxx_std_20)
  get_property(libraries GLOBAL PROPERTY MPM_LIBRARIES)
  install(TARGETS ${libraries} EXPORT mpm_par_targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(DIRECTORY include/mpm ${MPM_GENERATED}/mpm DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
          FILES_MATCHING PATTERN *.hpp PATTERN *.list)
  install(EXPORT mpm_par_targets NAMESPACE mpm:: DESTINATION ${MPM_CMAKE_FOLDER})
  configure_package_config_file(cmake/mpm_par-config.cmake.in mpm_par-config.cmake
                                INSTALL_DESTINATION ${MPM_CMAKE_FOLDER})
  write_basic_package_version_file(mpm_par-config-version.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/mpm_par-config.cmake
                ${PROJECT_BINARY_DIR}/mpm_par-config-version.cmake cmake/dependencies.cmake
          DESTINATION ${MPM_CMAKE_FOLDER})

  install(DIRECTORY inputs DESTINATION ${MPM_DATA_FOLDER})
  install(DIRECTORY jobscripts DESTINATION ${MPM_DATA_FOLDER}
          FILES_MATCHING PATTERN *.slurm PATTERN *.pbs PATTERN job.bash PATTERN environment.sh
                         PATTERN *.py PATTERN __pycache__ EXCLUDE)
  install(DIRECTORY docs DESTINATION ${MPM_DOC_FOLDER})
  install(FILES README.md packaging/licences.md DESTINATION ${MPM_DOC_FOLDER})
  install(FILES LICENSE DESTINATION ${MPM_DOC_FOLDER} RENAME copyright)
endmacro()
