#include "execution/thread_share.h"

#include "execution/side_by_side.h"

#include <algorithm>
#include <thread>
#include <utility>

namespace koebe {
namespace {

thread_local int share = 1;
thread_local bool beside = false;

int count_of(int threads)
{
    return threads > 0 ? threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace

ThreadShare::ThreadShare(int threads) : before_(std::exchange(share, count_of(threads))) {}
ThreadShare::~ThreadShare() { share = before_; }
int ThreadShare::here() { return beside ? 1 : share; }

BesideOthers::BesideOthers() : before_(std::exchange(beside, true)) {}
BesideOthers::~BesideOthers() { beside = before_; }

void each_beside(std::size_t count, const std::function<void(std::size_t i)>& work)
{
    const int threads = ThreadShare::here();
    if (threads == 1 || count == 1) {
        for (std::size_t i = 0; i < count; ++i) work(i);
        return;
    }
    ExecutionContext silent;
    side_by_side(count, threads, silent, [&](std::size_t i, ExecutionContext&) { work(i); });
}

void in_pieces(std::size_t size, std::size_t length,
               const std::function<void(std::size_t begin, std::size_t end)>& work)
{
    each_beside((size + length - 1) / length,
                [&](std::size_t i) { work(i * length, std::min(size, (i + 1) * length)); });
}

void in_ranges(std::size_t size, const std::function<void(std::size_t begin, std::size_t end)>& work)
{
    constexpr std::size_t shortest = 16384, most = 8;  // as each range looks at all data
    const std::size_t count =
        std::clamp(static_cast<std::size_t>(ThreadShare::here()), std::size_t{1}, std::min(most, size / shortest + 1));
    in_pieces(size, std::max<std::size_t>((size + count - 1) / count, 1), work);
}

}  // namespace koebe
