# SPDX-License-Identifier: GPL-3.0-or-later
# cpack runs this after it has put the package's files into CMAKE_INSTALL_PREFIX. Writes man
# pages from the --help of the programs. package.cmake sets program and the summaries.

set(folder "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/share/man/man1")
file(MAKE_DIRECTORY "${folder}")
# The other commands' help stands below that of the first one, as it is.
set(others "")
foreach(command IN ITEMS remove-noise fair)
  execute_process(COMMAND "${program}" ${command} --help OUTPUT_VARIABLE help
                  COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\\" "\\\\" help "${help}")
  string(REPLACE "-" "\\-" help "${help}")
  string(APPEND others "[tracked_mcf ${command}]\n.nf\n${help}.fi\n\n")
endforeach()
set(sections "${folder}/sections")
file(WRITE "${sections}" "${others}")
execute_process(COMMAND help2man --no-info --name "${summary}" --include "${sections}" --output "${folder}/tracked_mcf.1" "${program}"
                COMMAND_ERROR_IS_FATAL ANY)
file(REMOVE "${sections}")
execute_process(COMMAND "${program}" --version OUTPUT_VARIABLE version COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCH "[0-9][0-9.]*" version "${version}")
execute_process(COMMAND help2man --no-info --name "${folder_summary}" --version-string "${version}"
                        --output "${folder}/tracked_mcf_folder.1" "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/bin/tracked_mcf_folder"
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND gzip -9nf "${folder}/tracked_mcf.1" "${folder}/tracked_mcf_folder.1" COMMAND_ERROR_IS_FATAL ANY)
