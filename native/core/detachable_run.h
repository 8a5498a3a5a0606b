// Computations that can be left at once, even inside a kernel that does not ask whether it should go on.
#pragma once

#include "core/execution.h"

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

/// Keeps a thread that nobody waits for, and joins it before the process ends or once it is done.
void keep_until_done(std::thread thread, std::shared_ptr<const bool> done, std::shared_ptr<std::mutex> mutex);

}  // namespace detail

/// Runs a computation on a thread of its own, reports its progress on the calling thread, and answers a raised token
/// within 20 ms by Cancelled; the computation then ends at its next checkpoint, unseen. So it must own all it reads.
/// Its exceptions come out of here, and an exception of the progress callback leaves it in the same way.
template <class Result>
Result run_detachable(ExecutionContext& context, std::function<Result(ExecutionContext&)> compute)
{
    struct Shared {
        std::shared_ptr<std::mutex> mutex = std::make_shared<std::mutex>();
        std::condition_variable changed;
        std::deque<std::pair<double, std::string>> reports;
        std::shared_ptr<bool> done = std::make_shared<bool>(false);
        std::optional<Result> result;
        std::exception_ptr error;
        CancelToken token;
    };
    const auto shared = std::make_shared<Shared>();
    std::thread thread([shared, compute = std::move(compute)]() mutable {
        ExecutionContext inner(
            [&shared](double fraction, const std::string& stage) {
                const std::scoped_lock lock(*shared->mutex);
                shared->reports.emplace_back(fraction, stage);
                shared->changed.notify_one();
            },
            shared->token);
        std::optional<Result> result;
        std::exception_ptr error;
        try {
            result = compute(inner);
        } catch (...) {
            error = std::current_exception();
        }
        compute = nullptr;
        const std::scoped_lock lock(*shared->mutex);
        shared->result = std::move(result);
        shared->error = error;
        *shared->done = true;
        shared->changed.notify_one();
    });
    try {
        std::unique_lock lock(*shared->mutex);
        while (!*shared->done || !shared->reports.empty()) {
            if (shared->reports.empty()) shared->changed.wait_for(lock, std::chrono::milliseconds(20));
            const auto reports = std::exchange(shared->reports, {});
            lock.unlock();
            for (const auto& [fraction, stage] : reports) context.report(fraction, stage);
            context.checkpoint();
            lock.lock();
        }
    } catch (...) {
        shared->token.cancel();
        detail::keep_until_done(std::move(thread), shared->done, shared->mutex);
        throw;
    }
    thread.join();
    if (shared->error) std::rethrow_exception(shared->error);
    return *std::move(shared->result);
}

}  // namespace koebe
