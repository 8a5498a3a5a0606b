#include "native_call.h"

#include <atomic>
#include <condition_variable>
#include <mutex>

namespace koebe::python {
namespace {

namespace py = pybind11;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto between_polls = 20ms;
constexpr auto patience = 2s;  // for a progress callback that does not return

struct Calls {
    std::mutex mutex;
    std::condition_variable changed;
    int running = 0;
    bool ending = false;
    std::atomic<unsigned long> main_thread = 0;  ///< as from Python's get_ident
};

/// Never destroyed: a thread may come late.
Calls& calls()
{
    static Calls* const all = new Calls;
    return *all;
}

bool is_ending()
{
    const std::scoped_lock lock(calls().mutex);
    return calls().ending;
}

/// Ends a thread silently if nothing catches the exception. Call with the GIL.
[[noreturn]] void leave_thread()
{
    PyErr_SetString(PyExc_SystemExit, "the interpreter ends");
    throw py::error_already_set();
}

/// Kept, since asking for it runs Python, which may let another thread end the interpreter meanwhile.
void note_main_thread()
{
    calls().main_thread = py::cast<unsigned long>(py::module_::import("threading").attr("main_thread")().attr("ident"));
}

/// Waits at most 2 s for the calls of all threads; no new call starts. A thread whose call has ended uses Python only
/// with the GIL, so the count is read with the GIL.
void end_calls()
{
    const auto end = Clock::now() + patience;
    std::unique_lock lock(calls().mutex);
    calls().ending = true;
    while (calls().running > 0 && Clock::now() < end) {
        lock.unlock();
        {
            const py::gil_scoped_release release;
            std::unique_lock waiting(calls().mutex);
            calls().changed.wait_until(waiting, end, [] { return calls().running == 0; });
        }
        lock.lock();
    }
}

}  // namespace

Call::Call() : is_on_main_thread_(PyThread_get_thread_ident() == calls().main_thread)
{
    if (!is_on_main_thread_ && is_ending()) leave_thread();
    {
        const std::scoped_lock lock(calls().mutex);
        ++calls().running;
    }
    state_ = PyEval_SaveThread();
}

Call::~Call()
{
    in_python([this] { PyEval_RestoreThread(state_); });
    const std::scoped_lock lock(calls().mutex);
    --calls().running;
    calls().changed.notify_all();
}

Call::WithGil::WithGil(Call& call) : call_(call)
{
    in_python([this] { PyEval_RestoreThread(call_.state_); });
}

Call::WithGil::~WithGil() { call_.state_ = PyEval_SaveThread(); }

void Call::poll()
{
    if (Clock::now() - polled_ < between_polls) return;
    polled_ = Clock::now();
    if (!is_on_main_thread_ && !is_ending()) return;
    const WithGil gil(*this);
    if (!is_on_main_thread_) leave_thread();
    if (in_python(&PyErr_CheckSignals) != 0) throw py::error_already_set();
}

void watch_interpreter()
{
    note_main_thread();
    py::module_::import("atexit").attr("register")(py::cpp_function(&end_calls));
    const py::module_ os = py::module_::import("os");
    if (py::hasattr(os, "register_at_fork"))
        os.attr("register_at_fork")(py::arg("after_in_child") = py::cpp_function(&note_main_thread));
}

}  // namespace koebe::python
