// How Python calls the library: without the GIL, stopped by Ctrl-C, and over before the interpreter is.
#pragma once

#include "core/detachable_run.h"

#include <pybind11/pybind11.h>

#include <type_traits>
#include <utility>

namespace koebe::python {

/// Counts a call from Python. Once the interpreter ends, calls of other threads than the main one leave by SystemExit,
/// and it waits for them: a thread that asks for the GIL after that is ended by Python amid its C++ frames.
class Call {
public:
    Call();
    ~Call();
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

    /// To be called without the GIL, often: runs Python's signal handlers on the main thread, about every 20 ms, and
    /// throws what they raise, KeyboardInterrupt for one.
    void poll();

private:
    bool is_on_main_thread_;
    std::chrono::steady_clock::time_point polled_;
};

/// Waits, at most 2 s, for the calls of all threads; no other begins. To be called by `atexit`.
void end_calls();

/// Runs a computation that looks after its context without the GIL. Progress is called on this thread with it, and what
/// it raises ends the computation.
template <class Compute>
auto without_gil(const pybind11::object& progress, const CancelToken& token, Compute compute)
{
    Call call;
    ProgressCallback callback;
    if (!progress.is_none())
        callback = [&progress](double fraction, const std::string& stage) {
            const pybind11::gil_scoped_acquire gil;
            progress(fraction, stage);
        };
    ExecutionContext context(callback, token, [&call] { call.poll(); });
    const pybind11::gil_scoped_release release;
    return compute(context);
}

/// Faces of a mesh that takes a few milliseconds to go through: not worth a thread, which a busy machine lets wait.
constexpr Index small_mesh = 5000;

/// Runs any computation without the GIL, on a thread of its own unless it is short; what it reads must be its own.
template <class Compute>
auto detached(Compute compute, bool is_short = false)
{
    using Result = std::invoke_result_t<Compute>;
    return without_gil(pybind11::none(), {}, [&compute, is_short](ExecutionContext& context) {
        if (is_short) return compute();
        return run_detachable<Result>(context, [compute = std::move(compute)](ExecutionContext&) { return compute(); });
    });
}

}  // namespace koebe::python
