// Calls the library from Python: without the GIL, stopped by Ctrl-C, and finished before the interpreter ends.
#pragma once

#include "core/not_copied.h"
#include "execution/detachable_run.h"

#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>
#include <thread>
#include <type_traits>
#include <utility>

namespace koebe::python {

/// Runs code that takes the GIL or runs Python. Once the interpreter has ended, Python ends a thread that asks for the
/// GIL by unwinding its stack. A destructor turns that into std::terminate, and a translator of errors swallows it. So
/// the thread stops here for good, as in Python from 3.14 on. Exceptions of `act` pass.
template <class Act>
auto in_python(Act act)
{
    try {
        return act();
    } catch (const std::exception&) {
        throw;
    } catch (...) {
        while (true) std::this_thread::sleep_for(std::chrono::hours(1));
    }
}

/// A call from Python. Releases the GIL for its lifetime, and is counted. When the interpreter ends, it waits for
/// calls; calls of threads other than the main one leave by SystemExit.
class Call : NotCopied {
public:
    /// Call with the GIL.
    Call();
    ~Call();

    /// Call often, without the GIL. Runs Python's signal handlers on the main thread, about every 20 ms, and throws
    /// their exceptions, such as KeyboardInterrupt.
    void poll();

    /// Takes the GIL back for its lifetime, on the thread of the call.
    class WithGil : NotCopied {
    public:
        explicit WithGil(Call& call);
        ~WithGil();

    private:
        Call& call_;
    };

private:
    bool is_on_main_thread_;
    std::chrono::steady_clock::time_point polled_;
    PyThreadState* state_;
};

/// Call once, when the module is loaded: notes the main thread, and prepares for the end of the interpreter.
void watch_interpreter();

/// Runs a computation, which uses its context, without the GIL. Calls progress on this thread with the GIL; an
/// exception of progress ends the computation.
template <class Compute>
auto without_gil(const pybind11::object& progress, const CancelToken& token, Compute compute)
{
    Call call;
    ProgressCallback callback;
    if (!progress.is_none())
        callback = [&progress, &call](double fraction, const std::string& stage) {
            const Call::WithGil gil(call);
            in_python([&] { progress(fraction, stage); });
        };
    ExecutionContext context(callback, token, [&call] { call.poll(); });
    return compute(context);
}

/// Number of faces of a mesh that takes a few milliseconds: not worth a thread, which a busy machine may delay.
constexpr Index small_mesh = 5000;

/// Runs any computation without the GIL, on a thread of its own unless it is short. It must own the data that it reads.
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
