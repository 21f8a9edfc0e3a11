# SPDX-License-Identifier: GPL-3.0-or-later
# Builds for macOS 13 on the processor of TRACKED_MCF_ZIG_PROCESSOR, aarch64 or x86_64, with the Clang, libc++ and
# system headers of TRACKED_MCF_ZIG, the program zig.

list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES TRACKED_MCF_ZIG TRACKED_MCF_ZIG_PROCESSOR)
set(CMAKE_SYSTEM_NAME Darwin)
set(CMAKE_SYSTEM_PROCESSOR "${TRACKED_MCF_ZIG_PROCESSOR}")

# CMake wants each tool to be a program of its own.
set(folder "${CMAKE_BINARY_DIR}/zig")
file(MAKE_DIRECTORY "${folder}")
foreach(tool cc c++ ar ranlib)
  set(options)
  if(tool MATCHES "^c")
    set(options "-target ${TRACKED_MCF_ZIG_PROCESSOR}-macos.13.0")
  endif()
  file(WRITE "${folder}/${tool}" "#!/bin/sh\nexec '${TRACKED_MCF_ZIG}' ${tool} ${options} \"$@\"\n")
  file(CHMOD "${folder}/${tool}" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
endforeach()
set(CMAKE_C_COMPILER "${folder}/cc")
set(CMAKE_CXX_COMPILER "${folder}/c++")
set(CMAKE_AR "${folder}/ar" CACHE FILEPATH "")
set(CMAKE_RANLIB "${folder}/ranlib" CACHE FILEPATH "")
include("${CMAKE_CURRENT_LIST_DIR}/header_libraries.cmake")
