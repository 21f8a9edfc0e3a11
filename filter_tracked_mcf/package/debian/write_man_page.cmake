# SPDX-License-Identifier: GPL-3.0-or-later
# cpack runs this after it has put the package's files into CMAKE_INSTALL_PREFIX. Writes the program's man
# page from its --help. package.cmake sets program and summary.

set(folder "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/share/man/man1")
file(MAKE_DIRECTORY "${folder}")
execute_process(COMMAND help2man --no-info --name "${summary}" --output "${folder}/tracked_mcf.1" "${program}"
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND gzip -9nf "${folder}/tracked_mcf.1" COMMAND_ERROR_IS_FATAL ANY)
