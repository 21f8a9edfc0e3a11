# SPDX-License-Identifier: GPL-3.0-or-later
# tracked_mcf::highway: the headers of Google Highway. Nothing needs its library at run time.

find_path(TRACKED_MCF_HIGHWAY_INCLUDE_DIR hwy/highway.h
          DOC "Folder with Google Highway 1.0.3 or later, as hwy/highway.h")
if(TRACKED_MCF_HIGHWAY_INCLUDE_DIR)
  add_library(tracked_mcf_highway INTERFACE)
  add_library(tracked_mcf::highway ALIAS tracked_mcf_highway)
  target_include_directories(tracked_mcf_highway SYSTEM INTERFACE ${TRACKED_MCF_HIGHWAY_INCLUDE_DIR})
endif()
