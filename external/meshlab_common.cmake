# SPDX-License-Identifier: GPL-3.0-or-later
# libmeshlab-common, in two targets. meshlab::common is the real library, for programs that act as a
# host: the caller's own if given, or the installed one if it is of the release and precision that the
# plugin is for; MESHLAB_LIBRARY_DIR is where it lies, or empty if there is none.
#
# meshlab::common_for_plugins is what plugins link. Where there is no real one, and for PyMeshLab,
# which brings its own, nothing but the name is known of it: an empty library of that name stands in,
# and the host resolves what is left undefined.

set(MESHLAB_COMMON_LIBRARY "" CACHE FILEPATH
    "libmeshlab-common of the sources' release and MESHLAB_SCALAR; empty is the installed one if it fits")

# Of Debian's package, since the library does not tell its release.
function(find_installed_library result)
  find_library(installed meshlab-common PATH_SUFFIXES meshlab NO_CACHE)
  execute_process(COMMAND dpkg-query -W -f "\${Version}" meshlab
                  OUTPUT_VARIABLE version ERROR_QUIET RESULT_VARIABLE status)
  string(FIND "${version}" "${MESHLAB_SDK_RELEASE}" position)
  if(installed AND status EQUAL 0 AND position EQUAL 0 AND MESHLAB_SCALAR STREQUAL float)
    set(${result} "${installed}" PARENT_SCOPE)
  endif()
endfunction()

set(library "${MESHLAB_COMMON_LIBRARY}")
if(NOT library)
  find_installed_library(library)
endif()
set(library_dir "")
if(library)
  get_filename_component(library_dir "${library}" DIRECTORY)
  add_library(meshlab_common INTERFACE)
  add_library(meshlab::common ALIAS meshlab_common)
  target_link_libraries(meshlab_common INTERFACE "${library}")
endif()
set(MESHLAB_LIBRARY_DIR "${library_dir}" CACHE INTERNAL "Where MeshLab's libraries lie")

add_library(meshlab_common_for_plugins INTERFACE)
add_library(meshlab::common_for_plugins ALIAS meshlab_common_for_plugins)
if(library AND MESHLAB_SCALAR STREQUAL float)
  target_link_libraries(meshlab_common_for_plugins INTERFACE meshlab_common)
  target_link_options(meshlab_common_for_plugins INTERFACE -Wl,--no-undefined,--as-needed)
else()
  file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/nothing.cpp" "")
  add_library(meshlab_common_stand_in SHARED "${CMAKE_CURRENT_BINARY_DIR}/nothing.cpp")
  set_target_properties(meshlab_common_stand_in PROPERTIES OUTPUT_NAME meshlab-common)
  # Linked although nothing is found in it, and only it: of Qt, nothing that the plugin does not use.
  target_link_libraries(meshlab_common_for_plugins
                        INTERFACE -Wl,--no-as-needed meshlab_common_stand_in -Wl,--as-needed)
endif()
