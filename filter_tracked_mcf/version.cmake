# SPDX-License-Identifier: GPL-3.0-or-later
# The project's version. In MeshLab's own tree, the project is MeshLab.
set(TRACKED_MCF_VERSION 1.2.0)

# In a clone, the commits since then are a fourth number, so that a newer package replaces an older one. They count from
# the last tag such as v1.2.0, or else from the last change of this file.
if(EXISTS "${CMAKE_CURRENT_LIST_DIR}/../.git")
  find_program(TRACKED_MCF_GIT git)
  mark_as_advanced(TRACKED_MCF_GIT)
endif()
if(TRACKED_MCF_GIT)
  function(tracked_mcf_ask_git answer)
    execute_process(COMMAND "${TRACKED_MCF_GIT}" -C "${CMAKE_CURRENT_LIST_DIR}" ${ARGN} OUTPUT_VARIABLE said
                    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    set(${answer} "${said}" PARENT_SCOPE)
  endfunction()
  tracked_mcf_ask_git(described describe --tags --long --match "v[0-9]*")
  if(described MATCHES "^v([0-9.]+)-([0-9]+)-g" AND CMAKE_MATCH_1 VERSION_GREATER_EQUAL TRACKED_MCF_VERSION)
    set(TRACKED_MCF_VERSION ${CMAKE_MATCH_1})
    set(commits ${CMAKE_MATCH_2})
  else()
    tracked_mcf_ask_git(release log -1 --format=%H -- version.cmake)
    tracked_mcf_ask_git(commits rev-list --count "${release}..HEAD")
  endif()
  if(commits GREATER 0)
    string(APPEND TRACKED_MCF_VERSION ".${commits}")
  endif()
endif()
