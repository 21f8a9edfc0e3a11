# Where cmake --install puts things is found when it runs (find_places.cmake), since that depends on
# whose home it is run for. Here, what that must know; it comes before all other rules.

if(TRACKED_MCF_PLUGIN)
  set(TRACKED_MCF_HOST MeshLab)
  set(TRACKED_MCF_HOST_RELEASE ${MESHLAB_SDK_RELEASE})
  if(MESHLAB_SCALAR STREQUAL double)
    set(TRACKED_MCF_HOST PyMeshLab) # which has releases such as 2025.7
    string(REPLACE ".0" "." TRACKED_MCF_HOST_RELEASE ${MESHLAB_SDK_RELEASE})
  endif()
endif()

# Given with -D to the install script, they win.
foreach(name TRACKED_MCF_HOST TRACKED_MCF_HOST_RELEASE TRACKED_MCF_USER_INSTALL
             TRACKED_MCF_PLUGIN_DIR MESHLAB_LIBRARY_DIR)
  string(APPEND known "if(NOT DEFINED ${name})\n  set(${name} \"${${name}}\")\nendif()\n")
endforeach()
install(CODE "${known}" ALL_COMPONENTS)
install(SCRIPT package/find_places.cmake ALL_COMPONENTS)
