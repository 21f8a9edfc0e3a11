# SPDX-License-Identifier: GPL-3.0-or-later
# Prints the version of the clone: cmake -P print_version.cmake
include(${CMAKE_CURRENT_LIST_DIR}/../../version.cmake)
execute_process(COMMAND ${CMAKE_COMMAND} -E echo ${TRACKED_MCF_VERSION})
