# MESHLAB_SOURCE_DIR: a MeshLab source tree, for MeshLab's headers and vcglib. The user's own where
# given; else the source package of this Debian's meshlab, fetched once into the build folder.

if(NOT MESHLAB_SOURCE_DIR)
  set(fetched "${PROJECT_BINARY_DIR}/meshlab-source")
  if(NOT EXISTS "${fetched}/.complete")
    message(STATUS "Fetching the source package of meshlab into ${fetched}")
  endif()
  execute_process(
    COMMAND "${CMAKE_CURRENT_LIST_DIR}/meshlab_source.sh" "${fetched}"
    RESULT_VARIABLE status
    OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR
            "No MeshLab source tree. On Debian, apt-get could not fetch it (below). Elsewhere, unpack "
            "the sources of your MeshLab release, vcglib included, and configure with "
            "-DMESHLAB_SOURCE_DIR=/path/to/meshlab; or leave out what needs them with "
            "-DTRACKED_MCF_TOOL=OFF -DTRACKED_MCF_PLUGIN=OFF.\n${output}")
  endif()
  set(MESHLAB_SOURCE_DIR "${fetched}")
endif()
