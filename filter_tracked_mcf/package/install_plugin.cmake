# SPDX-License-Identifier: GPL-3.0-or-later
# cmake --install runs this for the plugin: copies tracked_mcf_plugin_file to the folder that
# find_folders.cmake has found, and prints how the host loads it.

cmake_minimum_required(VERSION 3.22)

if(NOT tracked_mcf_plugin_dir)
  set(reason "no MeshLab of that release was found when this was configured")
  if(TRACKED_MCF_USER_INSTALL)
    set(reason "TRACKED_MCF_USER_INSTALL asks for a user's installation")
  endif()
  message(FATAL_ERROR
          "MeshLab ${TRACKED_MCF_HOST_RELEASE} looks for plugins in its own folder alone, and "
          "${reason}. Configure with -DTRACKED_MCF_PLUGIN_DIR=FOLDER, or copy the plugin there "
          "yourself: ${tracked_mcf_plugin_file}")
endif()
file(INSTALL "${tracked_mcf_plugin_file}" DESTINATION "${tracked_mcf_plugin_dir}")

get_filename_component(name "${tracked_mcf_plugin_file}" NAME)

# Of two builds, MeshLab runs the one that it loads last: it loads the user's plugins after its own, and
# each folder by name.
set(folders "${tracked_mcf_plugin_dir}" "${tracked_mcf_user_plugin_dir}")
if(MESHLAB_LIBRARY_DIR)
  list(APPEND folders "${MESHLAB_LIBRARY_DIR}/plugins")
endif()
list(REMOVE_DUPLICATES folders)
foreach(folder IN LISTS folders)
  file(GLOB builds "$ENV{DESTDIR}${folder}/*tracked_mcf*.so")
  list(REMOVE_ITEM builds "$ENV{DESTDIR}${tracked_mcf_plugin_dir}/${name}")
  foreach(build IN LISTS builds)
    message(WARNING "MeshLab may run another build of the plugin. Remove it: ${build}")
  endforeach()
endforeach()

if(TRACKED_MCF_HOST STREQUAL PyMeshLab)
  message(STATUS "PyMeshLab ${TRACKED_MCF_HOST_RELEASE} loads it with "
                 "pymeshlab.load_plugin('${tracked_mcf_plugin_dir}/${name}')")
elseif(NOT TRACKED_MCF_PLUGIN_DIR)
  message(STATUS "MeshLab ${TRACKED_MCF_HOST_RELEASE} finds the plugin there when it starts")
endif()
