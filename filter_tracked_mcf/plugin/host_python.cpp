// SPDX-License-Identifier: GPL-3.0-or-later
// Looks CPython's functions up where they are: one plugin serves all versions of Python, and
// MeshLab, which has none. All of them are in the stable ABI.
#include "filter_tracked_mcf/plugin/host_python.h"

#ifndef _WIN32
#include <dlfcn.h>
#endif

#include <memory>

namespace tracked_mcf {

namespace {

struct Object;  // PyObject

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

/// An exception that Python code has raised, with its references.
struct Exception {
    Object *type = nullptr, *value = nullptr, *traceback = nullptr;
};

/// Raises the exception, an argument of Py_AddPendingCall(), and deletes it.
int raise(void* exception) {
    const std::unique_ptr<Exception> raised(static_cast<Exception*>(exception));
    find<void(Object*, Object*, Object*)>("PyErr_Restore")(raised->type, raised->value,
                                                           raised->traceback);
    return -1;
}

/// Holds the lock of Python's interpreter, which PyMeshLab releases while a filter runs.
class Lock {
public:
    Lock() : state_(find<int()>("PyGILState_Ensure")()) {}
    ~Lock() { find<void(int)>("PyGILState_Release")(state_); }
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;

private:
    int state_;
};

}  // namespace

bool python_runs() {
    auto* const is_initialized = find<int()>("Py_IsInitialized");
    return is_initialized != nullptr && is_initialized() != 0;
}

bool python_interrupts() {
    if (!python_runs()) return false;
    const Lock lock;
    if (find<int()>("PyErr_CheckSignals")() == 0) return false;
    // The host would replace the exception by one of its own, so Python raises it afterwards.
    auto* const raised = new Exception;
    find<void(Object**, Object**, Object**)>("PyErr_Fetch")(&raised->type, &raised->value,
                                                            &raised->traceback);
    auto* const add = find<int(int (*)(void*), void*)>("Py_AddPendingCall");
    return add(raise, raised) == 0;  // fails only if dozens of calls wait already
}

}  // namespace tracked_mcf
