# SPDX-License-Identifier: GPL-3.0-or-later
# For MeshLab's own tree, in place of the project's external/: gives its targets the names that ours link.

set(TRACKED_MCF_IN_MESHLAB ON)
set(TRACKED_MCF_PLUGIN ON)
include("${CMAKE_CURRENT_LIST_DIR}/version.cmake")

# MeshLab runs moc on everything. Only the plugin's class has Qt's macros, and its target asks for moc.
set(CMAKE_AUTOMOC OFF)
set(CMAKE_AUTOUIC OFF)
set(CMAKE_AUTORCC OFF)

set(MESHLAB_SDK_RELEASE ${MESHLAB_VERSION})
foreach(name sdk common_for_plugins)
  add_library(tracked_mcf_meshlab_${name} INTERFACE)
  add_library(meshlab::${name} ALIAS tracked_mcf_meshlab_${name})
  target_link_libraries(tracked_mcf_meshlab_${name} INTERFACE meshlab-common)
endforeach()

# MeshLab finds Eigen, or its own copy of it in vcglib.
if(NOT TARGET Eigen3::Eigen)
  add_library(tracked_mcf_eigen INTERFACE)
  add_library(Eigen3::Eigen ALIAS tracked_mcf_eigen)
  target_link_libraries(tracked_mcf_eigen INTERFACE vcglib)
endif()
