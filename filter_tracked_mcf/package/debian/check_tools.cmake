# SPDX-License-Identifier: GPL-3.0-or-later
# cpack runs this first. Without these tools, it would leave out dependencies that it cannot find.

foreach(name IN ITEMS dpkg-shlibdeps file help2man)
  find_program(found ${name} NO_CACHE)
  if(NOT found)
    message(FATAL_ERROR "cpack -G DEB needs ${name}. Run external/install_debian.sh package.")
  endif()
  unset(found)
endforeach()
