# SPDX-License-Identifier: GPL-3.0-or-later
# cpack runs this after it has put the package's files into CMAKE_INSTALL_PREFIX. Writes INSTALL.txt
# beside them. CMakeLists.txt sets name, version, host, release, scalar, processor,
# plugin_folder and files.

cmake_minimum_required(VERSION 3.22)

set(folder "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}")

function(needed_versions result)
  list(TRANSFORM ARGN PREPEND "${folder}/")
  execute_process(COMMAND "${CMAKE_CURRENT_LIST_DIR}/needed_versions.sh" ${ARGN}
                  OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
  string(STRIP "${output}" output)
  string(REPLACE "\n" ";" output "${output}")
  set(${result} "${output}" PARENT_SCOPE)
endfunction()

needed_versions(largest ${files})
foreach(set IN ITEMS GLIBC GLIBCXX CXXABI Qt)
  set(${set} "${largest}")
  list(FILTER ${set} INCLUDE REGEX "^${set}_[0-9]")
  string(REPLACE "${set}_" " " ${set} "${${set}}")
endforeach()
set(GCC " with GLIBCXX${GLIBCXX} and CXXABI${CXXABI}")

# The first GCC whose libstdc++ has these symbols, from the lists in its manual.
set(first_GLIBCXX 3.4.29=11 3.4.30=12 3.4.31=13 3.4.32=13.2 3.4.33=14 3.4.34=15)
set(first_CXXABI 1.3.13=11 1.3.14=13 1.3.15=14)
set(gcc 0)
foreach(set IN ITEMS GLIBCXX CXXABI)
  string(STRIP "${${set}}" needed)
  string(REGEX MATCH "(^|;)${needed}=([0-9.]+)" known "${first_${set}}")
  if(NOT known)
    set(gcc unknown)
  elseif(CMAKE_MATCH_2 VERSION_GREATER gcc AND NOT gcc STREQUAL unknown)
    set(gcc ${CMAKE_MATCH_2})
  endif()
endforeach()
if(NOT gcc STREQUAL unknown)
  string(PREPEND GCC " of GCC ${gcc},")
endif()

foreach(file IN LISTS files)
  needed_versions(versions ${file})
  list(JOIN versions " " versions)
  string(APPEND needs "    ${file}\n        ${versions}\n")
endforeach()
string(STRIP "${needs}" needs)
string(PREPEND needs "    ")
cmake_host_system_information(RESULT system QUERY DISTRIB_PRETTY_NAME)

set(menu "Remove other builds of the plugin: MeshLab loads all that it finds, and runs one of them.
The filter is in the menu Filters > Smoothing, Fairing and Deformation > Mean Curvature Flow.\n")
if(host STREQUAL PyMeshLab)
  set(steps "Put it into any folder. In Python:

    import pymeshlab
    pymeshlab.load_plugin('/path/libfilter_tracked_mcf.so')
    ms = pymeshlab.MeshSet()
    ms.load_new_mesh('scan.ply')
    ms.apply_filter('apply_coord_mean_curvature_flow')
    ms.save_current_mesh('smooth.ply')
")
elseif(release VERSION_LESS 2022.02)
  set(steps "Copy it, as root, to MeshLab's plugin folder. In Debian's MeshLab:

    cp libfilter_tracked_mcf.so ${plugin_folder}/

${menu}")
else()
  set(steps "In MeshLab, load it with Help > Plugin Info > Load Plugins. Or copy it to your plugin
folder and start MeshLab:

    data=\"\${XDG_DATA_HOME:-$HOME/.local/share}\"
    folder=\"$data/VCG/MeshLab_64bit_fp/MeshLabExtraPlugins/${release}\"
    mkdir -p \"$folder\"
    cp libfilter_tracked_mcf.so \"$folder/\"

${menu}")
endif()
set(program "")
if(tracked_mcf IN_LIST files)
  set(program "
tracked_mcf, the command-line program

It does not need ${host}. Run it from here, or copy it to a folder of your PATH, such as
~/.local/bin. tracked_mcf --help explains its options.
")
endif()
configure_file("${CMAKE_CURRENT_LIST_DIR}/INSTALL.txt.in" "${folder}/INSTALL.txt" @ONLY)
