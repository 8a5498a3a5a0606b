// How Python calls the library: without the GIL, stopped by Ctrl-C, and over before the interpreter is.
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

/// Runs what takes the GIL or runs Python. Once the interpreter has ended, Python ends a thread that asks for the GIL
/// by an unwinding of its stack, which a destructor turns into std::terminate and a translator of errors swallows:
/// there the thread stops here for good, as Python itself has it from 3.14 on. What `act` throws passes.
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

/// A call from Python: gives the GIL up for its lifetime, and counts. Once the interpreter ends, calls of other threads
/// than the main one leave by SystemExit, and it waits for them.
class Call : NotCopied {
public:
    /// To be made with the GIL.
    Call();
    ~Call();

    /// To be called without the GIL, often: runs Python's signal handlers on the main thread, about every 20 ms, and
    /// throws what they raise, KeyboardInterrupt for one.
    void poll();

    /// The GIL taken back for its lifetime, on the thread of the call.
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

/// To be called once, when the module is loaded: which thread is the main one, and what to do when the interpreter
/// ends.
void watch_interpreter();

/// Runs a computation that looks after its context without the GIL. Progress is called on this thread with it, and what
/// it raises ends the computation.
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
