# mpm_find_python(<VARIABLE> <modules>): a Python that imports these modules, into the cache; empty if
# there is none. Debian's packages serve Debian's Python, which need not be the first in PATH.
find_package(Python3 COMPONENTS Interpreter)
function(mpm_find_python variable modules)
  set(${variable} "" CACHE FILEPATH "Python with ${modules}")
  foreach(python ${Python3_EXECUTABLE} /usr/bin/python3)
    if(NOT ${variable})
      execute_process(COMMAND ${python} -c "import ${modules}"
                      RESULT_VARIABLE lacks OUTPUT_QUIET ERROR_QUIET)
      if(lacks EQUAL 0)
        set_property(CACHE ${variable} PROPERTY VALUE ${python})
      endif()
    endif()
  endforeach()
endfunction()
