// Independent pieces of work on several threads.
#pragma once

#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace koebe {

/// Calls work(i) for each i below count, on the calling thread and threads - 1 others. What a piece does must not depend on
/// which thread does it. Rethrows the exception of the lowest i that threw, after all have stopped.
template <class Work>
void parallel_for(int count, int threads, const Work& work)
{
    std::vector<std::exception_ptr> errors(count);
    std::atomic<int> next{0};
    std::atomic<bool> failed{false};
    const auto run = [&] {
        for (int i = next++; i < count && !failed; i = next++) {
            try {
                work(i);
            } catch (...) {
                errors[i] = std::current_exception();
                failed = true;
            }
        }
    };
    std::vector<std::thread> others;
    for (int t = 1; t < threads && t < count; ++t) others.emplace_back(run);
    run();
    for (std::thread& other : others) other.join();
    for (const std::exception_ptr& error : errors)
        if (error) std::rethrow_exception(error);
}

}  // namespace koebe
