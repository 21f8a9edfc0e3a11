# Where cmake --install puts the plugin: with the MeshLab that it was linked with; else, from 2022.02
# on, into the folder where MeshLab looks for a user's own plugins. PyMeshLab loads a plugin from
# anywhere.

option(TRACKED_MCF_USER_PLUGIN "Install the plugin for this user alone (MeshLab 2022.02 and later)"
       OFF)
if(DEFINED ENV{XDG_DATA_HOME})
  set(user_data "$ENV{XDG_DATA_HOME}")
else()
  set(user_data "$ENV{HOME}/.local/share")
endif()

if(MESHLAB_SCALAR STREQUAL double)
  include(GNUInstallDirs)
  set(plugin_dir "${CMAKE_INSTALL_LIBDIR}/pymeshlab")
elseif(MESHLAB_LIBRARY_DIR AND NOT TRACKED_MCF_USER_PLUGIN)
  set(plugin_dir "${MESHLAB_LIBRARY_DIR}/plugins")
elseif(MESHLAB_SDK_RELEASE VERSION_EQUAL 2020.09)
  set(plugin_dir "${CMAKE_INSTALL_PREFIX}/lib/meshlab/plugins")
else()
  set(plugin_dir "${user_data}/VCG/MeshLab_64bit_fp/MeshLabExtraPlugins/${MESHLAB_SDK_RELEASE}")
endif()
set(MESHLAB_PLUGIN_DIR "${plugin_dir}" CACHE PATH "Where cmake --install puts the plugin")
install(TARGETS filter_tracked_mcf LIBRARY DESTINATION "${MESHLAB_PLUGIN_DIR}")
