# SPDX-License-Identifier: GPL-3.0-or-later
# meshlab::sdk: what is compiled for a MeshLab release needs: the headers of MESHLAB_SOURCE_DIR, Qt 5
# and OpenGL; libmeshlab-common is apart. The sources say which release (MESHLAB_SDK_RELEASE, such as
# 2025.07), and so which adapter is built.

set(MESHLAB_SDK_RELEASE "${MESHLAB_SOURCE_RELEASE}" CACHE INTERNAL "Release of the MeshLab sources")
set(MESHLAB_SDK_SOURCE_DIR "${MESHLAB_SOURCE_DIR}" CACHE INTERNAL "The MeshLab sources")
if(NOT MESHLAB_SDK_RELEASE MATCHES "^(2020.09|2022.02|2025.07)$")
  message(FATAL_ERROR
          "MESHLAB_SOURCE_DIR holds MeshLab ${MESHLAB_SDK_RELEASE}, for which the plugin has not "
          "been tried: it is for 2020.09, 2022.02 and 2025.07.")
endif()
if(NOT MESHLAB_SCALAR MATCHES "^(float|double)$")
  message(FATAL_ERROR "MESHLAB_SCALAR is ${MESHLAB_SCALAR}; give float, or double for PyMeshLab.")
endif()
if(MESHLAB_SCALAR STREQUAL double AND MESHLAB_SDK_RELEASE VERSION_EQUAL 2020.09)
  message(FATAL_ERROR "There is no PyMeshLab of MeshLab 2020.09: for double, give the "
                      "sources of a later release.")
endif()

function(require_for_plugin found what debian_packages)
  if(NOT ${found})
    message(FATAL_ERROR
            "The MeshLab plugin needs ${what}. On Debian: apt-get install ${debian_packages}. "
            "Or leave the plugin out: -DTRACKED_MCF_PLUGIN=OFF.")
  endif()
endfunction()

find_path(MESHLAB_GLEW_INCLUDE_DIR GL/glew.h)
find_path(MESHLAB_GLU_INCLUDE_DIR GL/glu.h)
require_for_plugin(MESHLAB_GLEW_INCLUDE_DIR "the header GL/glew.h" libglew-dev)
require_for_plugin(MESHLAB_GLU_INCLUDE_DIR "the header GL/glu.h" libglu1-mesa-dev)
set(qt_modules Core Gui Widgets OpenGL Xml)
find_package(Qt5 QUIET COMPONENTS ${qt_modules})
require_for_plugin(Qt5_FOUND "Qt 5 with its OpenGL module" "qtbase5-dev libqt5opengl5-dev")

add_library(meshlab_sdk INTERFACE)
add_library(meshlab::sdk ALIAS meshlab_sdk)
include(meshlab_common.cmake)
target_include_directories(
  meshlab_sdk SYSTEM INTERFACE "${MESHLAB_SOURCE_DIR}/src" "${VCGLIB_INCLUDE_DIR}"
                               "${MESHLAB_GLEW_INCLUDE_DIR}" "${MESHLAB_GLU_INCLUDE_DIR}")
target_link_libraries(meshlab_sdk INTERFACE Eigen3::Eigen)

# A host loads a plugin only if it was compiled for its version and precision. PyMeshLab's version
# ends with a d.
set(version ${MESHLAB_SDK_RELEASE})
if(MESHLAB_SCALAR STREQUAL double)
  string(APPEND version d)
endif()
target_compile_definitions(meshlab_sdk INTERFACE MESHLAB_SCALAR=${MESHLAB_SCALAR}
                                                 MESHLAB_VERSION=${version})

# Targets that find_package imports are visible in this folder only, unless promoted.
set_target_properties(Qt5::moc PROPERTIES IMPORTED_GLOBAL TRUE)
foreach(module IN LISTS qt_modules)
  set_target_properties(Qt5::${module} PROPERTIES IMPORTED_GLOBAL TRUE)
  target_link_libraries(meshlab_sdk INTERFACE Qt5::${module})
endforeach()
