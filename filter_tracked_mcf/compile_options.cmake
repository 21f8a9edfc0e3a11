# SPDX-License-Identifier: GPL-3.0-or-later
# tracked_mcf::options: what every target of ours compiles with. Dependencies are SYSTEM, so the
# warnings are about our own code alone.

option(TRACKED_MCF_WERROR "Treat warnings as errors" OFF)

add_library(tracked_mcf_options INTERFACE)
add_library(tracked_mcf::options ALIAS tracked_mcf_options)
target_compile_features(tracked_mcf_options INTERFACE cxx_std_17)
target_include_directories(tracked_mcf_options INTERFACE ${TRACKED_MCF_INCLUDE_DIR})
if(MSVC)
  target_compile_options(tracked_mcf_options INTERFACE /W4 /permissive- /utf-8 /bigobj
                                                       $<$<BOOL:${TRACKED_MCF_WERROR}>:/WX>)
  target_compile_definitions(tracked_mcf_options INTERFACE _CRT_SECURE_NO_WARNINGS)
else()
  target_compile_options(
    tracked_mcf_options
    INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Wold-style-cast
              $<$<BOOL:${TRACKED_MCF_WERROR}>:-Werror>
              # Clang's -Wconversion includes it, but GCC's does not: indices are signed here.
              -Wno-sign-conversion
              # A compiler that fuses a product and a sum rounds once instead of twice. Processors
              # that can would give other bits than those that cannot.
              -ffp-contract=off)
endif()
if(WIN32)
  target_compile_definitions(tracked_mcf_options INTERFACE NOMINMAX _USE_MATH_DEFINES)
endif()
if(TRACKED_MCF_SANITIZE)
  target_compile_options(tracked_mcf_options INTERFACE -fsanitize=${TRACKED_MCF_SANITIZE}
                                                       -fno-omit-frame-pointer)
  target_link_options(tracked_mcf_options INTERFACE -fsanitize=${TRACKED_MCF_SANITIZE})
endif()
