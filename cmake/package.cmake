# `cpack -G DEB` in the build folder makes a Debian package of the programs, libraries and headers.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME mpm-par)
set(MPM_PACKAGER "The mpm_par authors <mpm_par@localhost>" CACHE STRING
    "Who answers for the Debian package")
set(CPACK_PACKAGE_CONTACT ${MPM_PACKAGER})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "crush wood with the material point method")
# The first paragraph of the README, as lines of a control file.
set(CPACK_PACKAGE_DESCRIPTION
"Takes a micrograph of wood, or of any cellular solid, turns it into material
points and crushes it to full densification with the material point method, on
a laptop or on a cluster. Built for processors: ${MPM_VECTOR}.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES TRUE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS TRUE)
# mpirun; what mpm_study and mpm_report import; what the libraries are linked with.
set(CPACK_DEBIAN_PACKAGE_DEPENDS openmpi-bin)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-yaml, python3-numpy, python3-h5py, python3-matplotlib, python3-pil")
string(CONCAT CPACK_DEBIAN_PACKAGE_SUGGESTS
  "petsc-dev, libhdf5-openmpi-dev, libmetis-dev, libeigen3-dev, libyaml-cpp-dev, libcli11-dev, "
  "libspdlog-dev, libfmt-dev, libpugixml-dev, nlohmann-json3-dev, libudunits2-dev, libmuparser-dev, "
  "libstb-dev, libtiff-dev, zlib1g-dev")
# Folders of others are theirs to read, whatever the umask of the build.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
include(CPack)
