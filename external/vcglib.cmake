# SPDX-License-Identifier: GPL-3.0-or-later
# vcglib, for the plugin and its tests: the headers, and plylib, the one source file that reading and
# writing PLY needs. It lies beside MeshLab's src in 2020.09 and inside it in later releases.

find_path(VCGLIB_INCLUDE_DIR vcg/complex/complex.h
          PATHS "${MESHLAB_SOURCE_DIR}/vcglib" "${MESHLAB_SOURCE_DIR}/src/vcglib"
          NO_DEFAULT_PATH NO_CACHE REQUIRED)

add_library(vcglib STATIC EXCLUDE_FROM_ALL "${VCGLIB_INCLUDE_DIR}/wrap/ply/plylib.cpp")
target_include_directories(vcglib SYSTEM PUBLIC "${VCGLIB_INCLUDE_DIR}")
target_link_libraries(vcglib PUBLIC Eigen3::Eigen)
target_compile_options(vcglib PRIVATE -w)
