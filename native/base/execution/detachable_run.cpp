#include "execution/detachable_run.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace koebe::detail {
namespace {

using namespace std::chrono_literals;

constexpr auto exit_patience = 500ms;  // an exit waits so long for abandoned computations
constexpr auto look_again = 2ms;

std::atomic<int> running{0};

#ifdef __GLIBC__

void end_the_process(int status, void*)
{
    const auto end = std::chrono::steady_clock::now() + exit_patience;
    while (running > 0 && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(look_again);
    if (running == 0) return;
    std::fflush(nullptr);
    std::_Exit(status);
}

bool watch_the_exit() { return on_exit(end_the_process, nullptr) == 0; }

#else

/// Waits for all computations where the exit status is not known.
void wait_for_all()
{
    while (running > 0) std::this_thread::sleep_for(look_again);
}

bool watch_the_exit() { return std::atexit(wait_for_all) == 0; }

#endif

}  // namespace

CountedRun::CountedRun()
{
    [[maybe_unused]] static const bool watched = watch_the_exit();
    ++running;
}

CountedRun::~CountedRun() { --running; }

}  // namespace koebe::detail
