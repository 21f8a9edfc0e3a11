# SPDX-License-Identifier: GPL-3.0-or-later
# MESHLAB_SOURCE_DIR: a MeshLab source tree, for MeshLab's headers and vcglib. The user's own where
# given; else Debian's sources of MESHLAB_RELEASE, or of this Debian's release, fetched once into the
# build folder. Sets MESHLAB_SOURCE_RELEASE to the release that they are of.

if(NOT MESHLAB_SOURCE_DIR)
  set(fetched "${PROJECT_BINARY_DIR}/meshlab-source")
  if(MESHLAB_RELEASE)
    string(APPEND fetched "-${MESHLAB_RELEASE}")
  endif()
  if(NOT EXISTS "${fetched}/.complete")
    message(STATUS "Fetching the sources of meshlab into ${fetched}")
  endif()
  execute_process(
    COMMAND "${CMAKE_CURRENT_LIST_DIR}/meshlab_source.sh" "${fetched}" ${MESHLAB_RELEASE}
    RESULT_VARIABLE status
    OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR
            "No MeshLab source tree. On Debian, apt-get could not fetch it (below). Elsewhere, unpack "
            "the sources of your MeshLab release, vcglib included, and configure with "
            "-DMESHLAB_SOURCE_DIR=/path/to/meshlab; or leave the plugin out: "
            "-DTRACKED_MCF_PLUGIN=OFF.\n${output}")
  endif()
  set(MESHLAB_SOURCE_DIR "${fetched}")
endif()

file(STRINGS "${MESHLAB_SOURCE_DIR}/ML_VERSION" MESHLAB_SOURCE_RELEASE LIMIT_COUNT 1)
if(MESHLAB_RELEASE AND NOT MESHLAB_RELEASE STREQUAL MESHLAB_SOURCE_RELEASE)
  message(FATAL_ERROR "MESHLAB_RELEASE is ${MESHLAB_RELEASE}, but MESHLAB_SOURCE_DIR holds MeshLab "
                      "${MESHLAB_SOURCE_RELEASE}; give the sources of that release, or none.")
endif()
