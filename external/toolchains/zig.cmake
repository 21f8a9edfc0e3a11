# SPDX-License-Identifier: GPL-3.0-or-later
# Builds for the system and processor of TRACKED_MCF_ZIG_TARGET with the Clang, libc++ and system headers of
# Zig (zig.sh): aarch64-macos.13.0, x86_64-macos.13.0, x86_64-linux-gnu.2.28,
# aarch64-linux-gnu.2.28. Its programs need nothing of the target but the C library.

list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES TRACKED_MCF_ZIG TRACKED_MCF_ZIG_TARGET)
if(TRACKED_MCF_ZIG_TARGET MATCHES macos)
  set(CMAKE_SYSTEM_NAME Darwin)
else()
  set(CMAKE_SYSTEM_NAME Linux)
endif()
string(REGEX MATCH "^[^-]+" CMAKE_SYSTEM_PROCESSOR "${TRACKED_MCF_ZIG_TARGET}")

# CMake wants each tool to be a program of its own.
set(folder "${CMAKE_BINARY_DIR}/zig")
file(MAKE_DIRECTORY "${folder}")
foreach(tool cc c++ ar ranlib)
  set(options)
  if(tool MATCHES "^c")
    set(options "-target ${TRACKED_MCF_ZIG_TARGET}")
  endif()
  file(WRITE "${folder}/${tool}" "#!/bin/sh\nexec '${TRACKED_MCF_ZIG}' ${tool} ${options} \"$@\"\n")
  file(CHMOD "${folder}/${tool}" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
endforeach()
set(CMAKE_EXE_LINKER_FLAGS_INIT -s) # as cpack strips other programs
set(CMAKE_C_COMPILER "${folder}/cc")
set(CMAKE_CXX_COMPILER "${folder}/c++")
set(CMAKE_AR "${folder}/ar" CACHE FILEPATH "")
set(CMAKE_RANLIB "${folder}/ranlib" CACHE FILEPATH "")
include("${CMAKE_CURRENT_LIST_DIR}/header_libraries.cmake")
