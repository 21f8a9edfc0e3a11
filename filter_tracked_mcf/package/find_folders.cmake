# SPDX-License-Identifier: GPL-3.0-or-later
# cmake --install runs this first. Sets tracked_mcf_plugin_dir, the folder for the plugin, or empties
# it if there is none, and tracked_mcf_user_plugin_dir, where MeshLab 2022.02 and later look for a
# user's own plugins. For a user's own installation, also sets CMAKE_INSTALL_PREFIX to ~/.local, unless
# a prefix other than CMake's default was given.
#
# A plugin goes to the MeshLab that it was linked with. Without one, from 2022.02 on, it goes to the
# folder where MeshLab looks for a user's own plugins. PyMeshLab loads a plugin from anywhere.

cmake_minimum_required(VERSION 3.22)

set(tracked_mcf_user_data "$ENV{XDG_DATA_HOME}")
if(NOT tracked_mcf_user_data)
  set(tracked_mcf_user_data "$ENV{HOME}/.local/share")
endif()

set(tracked_mcf_user_plugin_dir "${tracked_mcf_user_data}/VCG/MeshLab_64bit_fp/MeshLabExtraPlugins")
string(APPEND tracked_mcf_user_plugin_dir "/${TRACKED_MCF_HOST_RELEASE}")

set(tracked_mcf_for_user ${TRACKED_MCF_USER_INSTALL})
if(TRACKED_MCF_PLUGIN_DIR)
  set(tracked_mcf_plugin_dir "${TRACKED_MCF_PLUGIN_DIR}")
elseif(TRACKED_MCF_HOST STREQUAL PyMeshLab)
  set(tracked_mcf_plugin_dir "") # set below: it depends on the prefix
elseif(MESHLAB_LIBRARY_DIR AND NOT TRACKED_MCF_USER_INSTALL)
  set(tracked_mcf_plugin_dir "${MESHLAB_LIBRARY_DIR}/plugins")
elseif(TRACKED_MCF_HOST_RELEASE VERSION_GREATER_EQUAL 2022.02)
  set(tracked_mcf_for_user ON)
  set(tracked_mcf_plugin_dir "${tracked_mcf_user_plugin_dir}")
else()
  set(tracked_mcf_plugin_dir "")
endif()

if(tracked_mcf_for_user AND CMAKE_INSTALL_PREFIX STREQUAL "/usr/local")
  set(CMAKE_INSTALL_PREFIX "$ENV{HOME}/.local")
endif()
if(TRACKED_MCF_HOST STREQUAL PyMeshLab AND NOT TRACKED_MCF_PLUGIN_DIR)
  set(tracked_mcf_plugin_dir "${CMAKE_INSTALL_PREFIX}/lib/pymeshlab-${TRACKED_MCF_HOST_RELEASE}")
endif()
