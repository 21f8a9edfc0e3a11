# SPDX-License-Identifier: GPL-3.0-or-later
# Builds for ARM64 Linux with Debian's cross compiler, and runs the tests under QEMU. Needs
# `install_debian.sh arm64`.

set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc) # for GoogleTest
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L /usr/aarch64-linux-gnu)
include("${CMAKE_CURRENT_LIST_DIR}/header_libraries.cmake")
