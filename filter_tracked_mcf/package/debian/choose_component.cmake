# SPDX-License-Identifier: GPL-3.0-or-later
# cpack runs this for each generator: a Debian package has other files than the archive.

if(CPACK_GENERATOR STREQUAL DEB)
  if(NOT CPACK_DEBIAN_PACKAGE_NAME)
    message(FATAL_ERROR "A Debian package is for Debian's MeshLab, but this build is for another. "
                        "Install the package meshlab and build for its release, or make an archive: "
                        "cpack -G TGZ.")
  endif()
  # cpack itself would leave out dependencies that it cannot find.
  foreach(name IN ITEMS dpkg-shlibdeps file help2man)
    find_program(found ${name} NO_CACHE)
    if(NOT found)
      message(FATAL_ERROR "cpack -G DEB needs ${name}. Run external/install_debian.sh package.")
    endif()
    unset(found)
  endforeach()
  string(REPLACE ";package;" ";debian;" CPACK_INSTALL_CMAKE_PROJECTS
                 "${CPACK_INSTALL_CMAKE_PROJECTS}")
endif()
