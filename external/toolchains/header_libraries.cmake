# SPDX-License-Identifier: GPL-3.0-or-later
# Lets a cross compiler use this system's libraries that are headers alone, and nothing else of /usr: they
# are linked into a folder of the build, and CMake looks for packages there alone. Debian has the sources
# of GoogleTest for such cases.

set(folder "${CMAKE_BINARY_DIR}/header-libraries")
file(MAKE_DIRECTORY "${folder}/include" "${folder}/share/cmake")
foreach(path include/CLI include/eigen3 include/fast_float include/nlohmann share/eigen3
             share/cmake/CLI11 share/cmake/nlohmann_json)
  if(EXISTS "/usr/${path}" AND NOT EXISTS "${folder}/${path}")
    file(CREATE_LINK "/usr/${path}" "${folder}/${path}" SYMBOLIC)
  endif()
endforeach()
set(CMAKE_FIND_ROOT_PATH "${folder}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(TRACKED_MCF_GOOGLETEST_SOURCE /usr/src/googletest)
