#include "execution/side_by_side.h"

#include "execution/thread_memory.h"
#include "execution/thread_share.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace koebe {
namespace {

constexpr double least_report = 0.005;  // of the whole: each report wakes the thread that shows it

/// State shared by the threads.
struct Shared {
    std::atomic<std::size_t> next{0}, done{0};
    std::atomic<bool> stop{false};
    std::mutex mutex;
    std::size_t failed = 0;
    std::exception_ptr error;

    /// Work starts in order, so all work before the first failure is finished. So the thrown error does not depend on
    /// threads.
    void fail(std::size_t i)
    {
        const std::scoped_lock lock(mutex);
        if (!error || i < failed) {
            failed = i;
            error = std::current_exception();
        }
        stop = true;
    }
};

}  // namespace

void side_by_side(std::size_t count, int threads, ExecutionContext& context,
                  const std::function<void(std::size_t i, ExecutionContext& own)>& work)
{
    Shared shared;
    std::atomic<bool> left{false};  // the calling thread has been cancelled
    const auto run = [&](ExecutionContext& own, const std::function<void()>& after) {
        while (!shared.stop && !left) {
            const std::size_t i = shared.next++;
            if (i >= count) return;
            try {
                work(i, own);
            } catch (...) {
                shared.fail(i);
            }
            ++shared.done;
            if (after) after();
        }
    };
    const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
    const std::size_t most = threads > 0 ? static_cast<std::size_t>(threads) : cores;
    detail::StageNode* const stage = detail::stage_here();
    std::vector<std::thread> others;
    for (std::size_t k = 1; k < std::min(most, count); ++k) try {
            others.emplace_back([&] {
                const ProfiledThread profiled(stage);
                ExecutionContext own({}, {}, [&left, &context] {
                    if (left) throw Cancelled();
                    context.checkpoint();
                });
                try {
                    detail::take_thread_memory();
                } catch (const std::bad_alloc&) {
                    return;  // other threads do it
                }
                const BesideOthers beside;
                run(own, {});
            });
        } catch (const std::exception&) {
            break;  // no more threads can start: too many, or no memory
        }
    std::exception_ptr cancelled;
    try {
        ExecutionContext own({}, {}, [&context] { context.checkpoint(); });
        std::optional<BesideOthers> beside;
        if (!others.empty()) beside.emplace();
        double reported = 0.0;
        run(own, [&] {
            const double share = static_cast<double>(shared.done) / static_cast<double>(count);
            if (share < reported + least_report) return context.checkpoint();
            reported = share;
            context.advance(share);
        });
        context.checkpoint();
    } catch (...) {
        cancelled = std::current_exception();
        left = true;
    }
    {
        const ProfiledStage waiting("wait");
        for (std::thread& other : others) other.join();
    }
    if (cancelled) std::rethrow_exception(cancelled);
    if (shared.error) std::rethrow_exception(shared.error);
    context.advance(1.0);  // another thread may have done the last piece
}

}  // namespace koebe
