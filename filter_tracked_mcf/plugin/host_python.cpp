// SPDX-License-Identifier: GPL-3.0-or-later
// Looks CPython's functions up where they are: one plugin serves all versions of Python, and
// MeshLab, which has none. All of them are in the stable ABI.
#include "filter_tracked_mcf/plugin/host_python.h"

#ifndef _WIN32
#include <dlfcn.h>
#endif

namespace tracked_mcf {

namespace {

/// Null where there is no such function.
template <class Function>
Function* find(const char* name) {
#ifdef _WIN32
    (void)name;
    return nullptr;
#else
    return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
#endif
}

}  // namespace

bool python_runs() {
    auto* const is_initialized = find<int()>("Py_IsInitialized");
    return is_initialized != nullptr && is_initialized() != 0;
}

}  // namespace tracked_mcf
