// Computations that can be abandoned at once, even inside a kernel without checkpoints.
#pragma once

#include "core/api.h"
#include "core/not_copied.h"
#include "execution/execution.h"
#include "execution/thread_memory.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace koebe {

namespace detail {

/// Counts a computation from its start to the end of its thread. Libraries are taken down when the process exits, so an
/// exit waits for counted computations. If one does not end soon, as it was abandoned in a kernel without checkpoints,
/// the process ends without taking libraries down.
class KOEBE_API CountedRun : NotCopied {
public:
    CountedRun();
    ~CountedRun();
};

}  // namespace detail

/// Runs a computation on a thread of its own, reports its progress on the calling thread, and throws Cancelled within
/// 20 ms of a raised token. The abandoned computation ends at its next checkpoint, so it must own all data that it
/// reads. Throws the computation's exceptions, and those of the progress and the poll callback, which abandon it.
template <class Result>
Result run_detachable(ExecutionContext& context, std::function<Result(ExecutionContext&)> compute)
{
#ifdef __EMSCRIPTEN__  // no threads: a page ends the worker that computes
    return compute(context);
#else
    // All that both threads touch lives as long as the later one of them.
    struct Shared {
        detail::CountedRun counted;
        std::mutex mutex;
        std::condition_variable changed;
        std::deque<std::pair<double, std::string>> reports;
        bool done = false;
        std::optional<Result> result;
        std::exception_ptr error;
        CancelToken token;
    };
    auto shared = std::make_shared<Shared>();
    // The computation. What it owns is freed before its end is reported.
    std::thread thread([shared, compute = std::move(compute), stage = detail::stage_here()]() mutable {
        const ProfiledThread profiled(stage);
        ExecutionContext inner(
            [&shared](double fraction, const std::string& stage) {
                const std::scoped_lock lock(shared->mutex);
                shared->reports.emplace_back(fraction, stage);
                shared->changed.notify_one();
            },
            shared->token);
        std::optional<Result> result;
        std::exception_ptr error;
        try {
            detail::take_thread_memory();
            result = compute(inner);
        } catch (...) {
            error = std::current_exception();
        }
        compute = nullptr;
        const std::scoped_lock lock(shared->mutex);
        shared->result = std::move(result);
        shared->error = error;
        shared->done = true;
        shared->changed.notify_one();
    });
    // The caller passes reports on, and asks for a raised token every 20 ms.
    const ProfiledStage waiting("wait");
    try {
        std::unique_lock lock(shared->mutex);
        while (!shared->done || !shared->reports.empty()) {
            if (shared->reports.empty()) shared->changed.wait_for(lock, std::chrono::milliseconds(20));
            const auto reports = std::exchange(shared->reports, {});
            lock.unlock();
            for (const auto& [fraction, stage] : reports) context.report(fraction, stage);
            context.checkpoint();
            lock.lock();
        }
    } catch (...) {
        shared->token.cancel();
        thread.detach();
        throw;
    }
    thread.join();
    if (shared->error) std::rethrow_exception(shared->error);
    return *std::move(shared->result);
#endif
}

}  // namespace koebe
