# SPDX-License-Identifier: GPL-3.0-or-later
# tracked_mcf::options: what every target of ours compiles with. Dependencies are SYSTEM, so the
# warnings, which are errors, are about our own code alone.

add_library(tracked_mcf_options INTERFACE)
add_library(tracked_mcf::options ALIAS tracked_mcf_options)
target_compile_features(tracked_mcf_options INTERFACE cxx_std_17)
target_include_directories(tracked_mcf_options INTERFACE ${TRACKED_MCF_INCLUDE_DIR})
target_compile_options(
  tracked_mcf_options
  INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Wold-style-cast
            -Werror
            # Clang's -Wconversion includes it, but GCC's does not: indices are signed here.
            -Wno-sign-conversion)
if(TRACKED_MCF_SANITIZE)
  target_compile_options(tracked_mcf_options INTERFACE -fsanitize=${TRACKED_MCF_SANITIZE}
                                                       -fno-omit-frame-pointer)
  target_link_options(tracked_mcf_options INTERFACE -fsanitize=${TRACKED_MCF_SANITIZE})
endif()
