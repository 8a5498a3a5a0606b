#include "native_call.h"

namespace koebe::python {
namespace {

namespace py = pybind11;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto between_polls = 20ms;
constexpr auto patience = 2s;  // with a progress callback that does not come back

struct Calls {
    std::mutex mutex;
    std::condition_variable changed;
    int running = 0;
    bool ending = false;
};

/// Never taken down: a thread may come late.
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

/// Ends a thread without a word where nothing catches it. To be called with the GIL.
[[noreturn]] void leave_thread()
{
    PyErr_SetString(PyExc_SystemExit, "the interpreter ends");
    throw py::error_already_set();
}

}  // namespace

Call::Call()
{
    const py::module_ threading = py::module_::import("threading");
    is_on_main_thread_ = threading.attr("get_ident")().equal(threading.attr("main_thread")().attr("ident"));
    if (!is_on_main_thread_ && is_ending()) leave_thread();
    const std::scoped_lock lock(calls().mutex);
    ++calls().running;
}

Call::~Call()
{
    const std::scoped_lock lock(calls().mutex);
    --calls().running;
    calls().changed.notify_all();
}

void Call::poll()
{
    if (Clock::now() - polled_ < between_polls) return;
    polled_ = Clock::now();
    if (!is_on_main_thread_ && !is_ending()) return;
    const py::gil_scoped_acquire gil;
    if (!is_on_main_thread_) leave_thread();
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

void end_calls()
{
    const py::gil_scoped_release release;
    std::unique_lock lock(calls().mutex);
    calls().ending = true;
    calls().changed.wait_for(lock, patience, [] { return calls().running == 0; });
}

}  // namespace koebe::python
