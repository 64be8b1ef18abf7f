# mpm_find_python(<VARIABLE> <modules> <what for>): a Python that imports these modules, into the cache; empty if
# there is none, and then the reason on the screen. Debian's packages serve Debian's Python, which need not be the
# first in PATH.
find_package(Python3 COMPONENTS Interpreter)
function(mpm_find_python variable modules purpose)
  set(${variable} "" CACHE FILEPATH "Python with ${modules}")
  if(${variable})
    return()
  endif()
  set(tried ${Python3_EXECUTABLE} /usr/bin/python3)
  list(REMOVE_DUPLICATES tried)
  set(reasons)
  foreach(python ${tried})
    execute_process(COMMAND ${python} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/lacking_modules.py "${modules}"
                    RESULT_VARIABLE failed OUTPUT_VARIABLE lacks ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(failed)
      string(APPEND reasons "\n  ${python} does not run")
    elseif(lacks)
      string(APPEND reasons "\n  ${python} lacks ${lacks}")
    else()
      set_property(CACHE ${variable} PROPERTY VALUE ${python})
      return()
    endif()
  endforeach()
  message(STATUS "No ${purpose}: no Python has all of ${modules}${reasons}\n"
                 "  Run sh jobscripts/install_packages.sh and configure again, or give -D${variable}=FILE.")
endfunction()

# mpm_python_program(<name>): the launcher <name>.in of this folder becomes a program of the build, which
# starts <name>.py here, and one of the installation, with the folder's modules; there
# @MPM_PYTHON_FOLDER@ is relative to the launcher's own $here.
function(mpm_python_program name)
  set(executable FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
                                  WORLD_READ WORLD_EXECUTE)
  set(MPM_PYTHON_FOLDER ${CMAKE_CURRENT_SOURCE_DIR})
  configure_file(${name}.in ${CMAKE_BINARY_DIR}/${name} @ONLY ${executable})
  file(RELATIVE_PATH to_data ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_DATADIR})
  set(MPM_PYTHON_FOLDER "$here/${to_data}/mpm_par/${name}")
  configure_file(${name}.in ${CMAKE_CURRENT_BINARY_DIR}/${name} @ONLY ${executable})
  install(PROGRAMS ${CMAKE_CURRENT_BINARY_DIR}/${name} DESTINATION ${CMAKE_INSTALL_BINDIR})
  file(GLOB modules CONFIGURE_DEPENDS *.py)
  install(FILES ${modules} DESTINATION ${CMAKE_INSTALL_DATADIR}/mpm_par/${name})
endfunction()
