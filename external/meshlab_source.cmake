# SPDX-License-Identifier: GPL-3.0-or-later
# MESHLAB_SOURCE_DIR: a MeshLab source tree, for MeshLab's headers and vcglib. The user's own where
# given; else the one that meshlab_source.sh has put into the build folder. CMake itself fetches nothing.
# Sets MESHLAB_SOURCE_RELEASE to the release of the sources.

if(NOT MESHLAB_SOURCE_DIR)
  set(MESHLAB_SOURCE_DIR "${PROJECT_BINARY_DIR}/meshlab-source")
  if(NOT EXISTS "${MESHLAB_SOURCE_DIR}/ML_VERSION")
    # Indented lines are not wrapped.
    message(FATAL_ERROR
            "The MeshLab plugin needs MeshLab's sources. On Debian, fetch them, then configure again:\n"
            "  ${CMAKE_CURRENT_LIST_DIR}/meshlab_source.sh ${MESHLAB_SOURCE_DIR}\n"
            "Elsewhere, unpack the sources of your MeshLab release, vcglib included, and configure with "
            "-DMESHLAB_SOURCE_DIR=/path/to/meshlab; or leave the plugin out: "
            "-DTRACKED_MCF_PLUGIN=OFF.")
  endif()
endif()
if(NOT EXISTS "${MESHLAB_SOURCE_DIR}/ML_VERSION")
  message(FATAL_ERROR "MESHLAB_SOURCE_DIR is ${MESHLAB_SOURCE_DIR}, which holds no sources of MeshLab: "
                      "give the folder that has the file ML_VERSION.")
endif()
file(STRINGS "${MESHLAB_SOURCE_DIR}/ML_VERSION" MESHLAB_SOURCE_RELEASE LIMIT_COUNT 1)
