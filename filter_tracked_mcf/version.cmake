# SPDX-License-Identifier: GPL-3.0-or-later
# The project's version. In MeshLab's own tree, the project is MeshLab.
set(TRACKED_MCF_VERSION 1.1.0)

# In a clone, the commits since then are a fourth number, so that a newer package replaces an older one.
if(EXISTS "${CMAKE_CURRENT_LIST_DIR}/../.git")
  find_program(TRACKED_MCF_GIT git)
  mark_as_advanced(TRACKED_MCF_GIT)
endif()
if(TRACKED_MCF_GIT)
  execute_process(
    COMMAND "${TRACKED_MCF_GIT}" -C "${CMAKE_CURRENT_LIST_DIR}" log -1 --format=%H -- version.cmake
    OUTPUT_VARIABLE release OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  execute_process(
    COMMAND "${TRACKED_MCF_GIT}" -C "${CMAKE_CURRENT_LIST_DIR}" rev-list --count "${release}..HEAD"
    OUTPUT_VARIABLE commits OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed AND commits GREATER 0)
    string(APPEND TRACKED_MCF_VERSION ".${commits}")
  endif()
endif()
