# SPDX-License-Identifier: GPL-3.0-or-later
# cpack runs this for each generator: a Debian package has other files than the archive.

if(CPACK_GENERATOR STREQUAL DEB)
  if(NOT CPACK_DEBIAN_PACKAGE_NAME)
    message(FATAL_ERROR "A Debian package is for Debian's MeshLab, but this build is for another. "
                        "Install the package meshlab and build for its release, or make an archive: "
                        "cpack -G TGZ.")
  endif()
  string(REPLACE ";package;" ";debian;" CPACK_INSTALL_CMAKE_PROJECTS
                 "${CPACK_INSTALL_CMAKE_PROJECTS}")
endif()
