# SPDX-License-Identifier: GPL-3.0-or-later
# Builds for 64-bit Windows with Debian's MinGW-w64, and runs the tests under Wine. Needs
# `install_debian.sh windows`.

set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR AMD64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix) # for GoogleTest
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
# Programs then need no libraries beside them. CMake would find the library that loads a DLL.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_CROSSCOMPILING_EMULATOR wine)
include("${CMAKE_CURRENT_LIST_DIR}/header_libraries.cmake")
