#include "core/detachable_run.h"

#include <vector>

namespace koebe::detail {
namespace {

struct Kept {
    std::thread thread;
    std::shared_ptr<const bool> done;
    std::shared_ptr<std::mutex> mutex;

    bool ended() const
    {
        const std::scoped_lock lock(*mutex);
        return *done;
    }
};

struct Keeper {
    std::mutex mutex;
    std::vector<Kept> threads;

    /// The libraries a thread works in are gone once the process ends: wait for it.
    ~Keeper()
    {
        for (Kept& kept : threads) kept.thread.join();
    }
};

}  // namespace

void keep_until_done(std::thread thread, std::shared_ptr<const bool> done, std::shared_ptr<std::mutex> mutex)
{
    static Keeper keeper;
    const std::scoped_lock lock(keeper.mutex);
    std::erase_if(keeper.threads, [](Kept& kept) {
        if (!kept.ended()) return false;
        kept.thread.join();
        return true;
    });
    keeper.threads.push_back({std::move(thread), std::move(done), std::move(mutex)});
}

}  // namespace koebe::detail
