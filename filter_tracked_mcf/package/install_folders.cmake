# SPDX-License-Identifier: GPL-3.0-or-later
# find_folders.cmake finds the folders when cmake --install runs, because they depend on the user's
# home. This file passes it what the configuration knows, before all other install rules.

if(TRACKED_MCF_PLUGIN)
  set(TRACKED_MCF_HOST MeshLab)
  set(TRACKED_MCF_HOST_RELEASE ${MESHLAB_SDK_RELEASE})
  if(MESHLAB_SCALAR STREQUAL double)
    set(TRACKED_MCF_HOST PyMeshLab) # its releases are named like 2025.7
    string(REPLACE ".0" "." TRACKED_MCF_HOST_RELEASE ${MESHLAB_SDK_RELEASE})
  endif()
endif()

# Values given with -D to the install script have precedence.
foreach(name TRACKED_MCF_HOST TRACKED_MCF_HOST_RELEASE TRACKED_MCF_USER_INSTALL
             TRACKED_MCF_PLUGIN_DIR MESHLAB_LIBRARY_DIR)
  string(APPEND known "if(NOT DEFINED ${name})\n  set(${name} \"${${name}}\")\nendif()\n")
endforeach()
install(CODE "${known}" ALL_COMPONENTS)
install(SCRIPT package/find_folders.cmake ALL_COMPONENTS)
install(FILES LICENSE package/THIRD_PARTY.txt DESTINATION share/doc/filter_tracked_mcf)
