# Everything comes from Debian / Ubuntu packages by name: see jobscripts/install_packages.sh.
set(MPI_CXX_SKIP_MPICXX TRUE)
find_package(MPI 3.0 REQUIRED COMPONENTS C CXX)
find_package(Threads REQUIRED)

find_package(PkgConfig REQUIRED)
pkg_check_modules(PETSC REQUIRED IMPORTED_TARGET PETSc>=3.15)
# Debian's tells how it was built itself, which is not for those who use it.
set(petsc_options ${PETSC_CFLAGS_OTHER})
list(FILTER petsc_options EXCLUDE REGEX "^-(Wdate-time|D_FORTIFY_SOURCE=.*)$")
set_target_properties(PkgConfig::PETSC PROPERTIES INTERFACE_COMPILE_OPTIONS "${petsc_options}")
pkg_check_modules(UDUNITS REQUIRED IMPORTED_TARGET udunits)
pkg_check_modules(MUPARSER REQUIRED IMPORTED_TARGET muparser)

# With serial HDF5 also installed FindHDF5 would take that one, and fail only at run time.
set(HDF5_PREFER_PARALLEL TRUE)
find_package(HDF5 1.10 REQUIRED COMPONENTS C)
if(NOT HDF5_IS_PARALLEL)
  message(FATAL_ERROR "HDF5 in ${HDF5_C_INCLUDE_DIRS} is serial; the parallel one is needed "
                      "(Debian: libhdf5-openmpi-dev, or -DHDF5_C_COMPILER_EXECUTABLE=h5pcc)")
endif()

# Debian ships METIS without a CMake or pkg-config file.
find_path(METIS_INCLUDE_DIR metis.h REQUIRED)
find_library(METIS_LIBRARY metis REQUIRED)
file(STRINGS ${METIS_INCLUDE_DIR}/metis.h METIS_VERSION REGEX "define METIS_VER_")
string(REGEX REPLACE "[^;0-9]*([0-9]+)[^;]*" "\\1" METIS_VERSION "${METIS_VERSION}")
string(REPLACE ";" "." METIS_VERSION "${METIS_VERSION}")
add_library(METIS::METIS UNKNOWN IMPORTED)
set_target_properties(METIS::METIS PROPERTIES IMPORTED_LOCATION ${METIS_LIBRARY}
                      INTERFACE_INCLUDE_DIRECTORIES ${METIS_INCLUDE_DIR})

find_package(Eigen3 3.3 REQUIRED NO_MODULE)
find_package(yaml-cpp REQUIRED)
if(NOT TARGET yaml-cpp::yaml-cpp)  # 0.7 exports yaml-cpp only
  add_library(yaml-cpp::yaml-cpp ALIAS yaml-cpp)
endif()
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(pugixml REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(TIFF REQUIRED)
find_package(ZLIB REQUIRED)
find_path(STB_INCLUDE_DIR stb_image.h PATH_SUFFIXES stb REQUIRED)
