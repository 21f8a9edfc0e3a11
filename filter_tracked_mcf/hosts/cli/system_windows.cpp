// SPDX-License-Identifier: GPL-3.0-or-later
// windows.h comes first: the other headers need its types.
#include <windows.h>
//
#include <shellapi.h>

#include <csignal>
#include <cstdlib>

#include "filter_tracked_mcf/hosts/cli/system.h"

namespace tracked_mcf {

namespace {

std::string utf8(const wchar_t* wide) {
    // Both lengths include the terminating zero.
    const int length = WideCharToMultiByte(CP_UTF8, 0, wide, -1, nullptr, 0, nullptr, nullptr);
    std::string narrow(static_cast<std::size_t>(length), '\0');
    WideCharToMultiByte(CP_UTF8, 0, wide, -1, narrow.data(), length, nullptr, nullptr);
    narrow.pop_back();
    return narrow;
}

void (*interrupt_handler)(int number) = nullptr;

BOOL WINAPI on_console_event(DWORD event) {
    const bool is_key = event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT;
    interrupt_handler(is_key ? SIGINT : SIGTERM);
    // After the other events, Windows would end the program as soon as this function returns. The
    // main thread has a few seconds to end it first.
    if (!is_key) Sleep(INFINITE);
    return TRUE;
}

}  // namespace

std::vector<std::string> utf8_arguments(int /*argc*/, const char* const* /*argv*/) {
    SetConsoleOutputCP(CP_UTF8);
    // What main() gets has lost the letters that the system's code page lacks.
    int count = 0;
    wchar_t** const wide = CommandLineToArgvW(GetCommandLineW(), &count);
    std::vector<std::string> arguments;
    for (int i = 1; i < count; ++i) arguments.push_back(utf8(wide[i]));
    LocalFree(wide);
    return arguments;
}

bool writes_to_terminal() {
    const HANDLE errors = GetStdHandle(STD_ERROR_HANDLE);
    DWORD mode = 0;
    return GetConsoleMode(errors, &mode) != 0 &&
           SetConsoleMode(errors, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

void let_writes_fail_at_file_limits() {}

void call_on_interrupts(void (*handler)(int number)) {
    interrupt_handler = handler;
    SetConsoleCtrlHandler(on_console_event, TRUE);
}

void die_of_interrupt(int number) {
    std::_Exit(128 + number);
}

}  // namespace tracked_mcf
