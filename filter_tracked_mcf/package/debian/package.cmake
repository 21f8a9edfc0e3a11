# SPDX-License-Identifier: GPL-3.0-or-later
# The fields and the files of the Debian package.

set(CPACK_PROJECT_CONFIG_FILE "${CMAKE_CURRENT_LIST_DIR}/check_tools.cmake")
set(CPACK_DEBIAN_PACKAGE_NAME meshlab-plugin-tracked-mcf)
# Packages of one version for the MeshLabs of several Debians differ in this revision.
set(CPACK_DEBIAN_PACKAGE_RELEASE "1+meshlab${MESHLAB_SDK_RELEASE}")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
# Debian's tools take the name and the address of a package's maker from these variables.
set(maintainer "Filter Tracked MCF <unknown@filter-tracked-mcf.invalid>")
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${maintainer}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "MeshLab filters that smooth, denoise and repair meshes")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "The filter Mean Curvature Flow removes detail smaller than a given length
from triangle meshes and keeps larger shapes. Each step is implicit, so it is
stable at any size. Remove Noise measures the noise of scans and parts, removes
it, and keeps creases. Fair Selected Faces makes filled holes continue the
surface around them.
.
This package has the filters for MeshLab ${MESHLAB_SDK_RELEASE}, the program tracked_mcf,
which does the same to PLY, OBJ, OFF and STL files, and the command
tracked_mcf_folder, which runs the program on all meshes of a folder.")

# MeshLab's library has no stable interface: a plugin is for one release. Debian's versions begin with
# the release, then + or ~, both of which are before a dot.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "meshlab (>= ${MESHLAB_SDK_RELEASE}~)"
                                 "meshlab (<< ${MESHLAB_SDK_RELEASE}.~)")
list(JOIN CPACK_DEBIAN_PACKAGE_DEPENDS ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${MESHLAB_LIBRARY_DIR}")
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(component COMPONENT debian EXCLUDE_FROM_ALL)
set(documents share/doc/${CPACK_DEBIAN_PACKAGE_NAME})
file(RELATIVE_PATH plugins /usr "${MESHLAB_LIBRARY_DIR}/plugins")
install(TARGETS filter_tracked_mcf LIBRARY DESTINATION ${plugins} ${component})
if(TRACKED_MCF_TOOL)
  install(TARGETS tracked_mcf RUNTIME DESTINATION bin ${component})
  install(PROGRAMS "${PROJECT_SOURCE_DIR}/filter_tracked_mcf/hosts/cli/tracked_mcf_folder.sh" DESTINATION bin
          RENAME tracked_mcf_folder ${component})
  install(CODE "set(program \"$<TARGET_FILE:tracked_mcf>\")
set(summary \"smooth, denoise and repair triangle meshes\")
set(folder_summary \"smooth or denoise the triangle meshes of a folder\")" ${component})
  install(SCRIPT "${CMAKE_CURRENT_LIST_DIR}/write_man_page.cmake" ${component})
endif()
install(FILES "${CMAKE_CURRENT_LIST_DIR}/copyright" "${CMAKE_CURRENT_LIST_DIR}/../THIRD_PARTY.txt"
        DESTINATION ${documents} ${component})

# Debian wants the project's changelog and that of the package, compressed.
set(changelogs "${CMAKE_CURRENT_BINARY_DIR}/debian")
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file("${PROJECT_SOURCE_DIR}/.github/CHANGELOG.md" "${changelogs}/changelog" COPYONLY)
configure_file("${CMAKE_CURRENT_LIST_DIR}/changelog.in" "${changelogs}/changelog.Debian" @ONLY)
execute_process(COMMAND gzip -9nkf changelog changelog.Debian WORKING_DIRECTORY "${changelogs}"
                COMMAND_ERROR_IS_FATAL ANY)
install(FILES "${changelogs}/changelog.gz" "${changelogs}/changelog.Debian.gz"
        DESTINATION ${documents} ${component})
