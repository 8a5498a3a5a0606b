#include "core/errors.h"
#include "execution/side_by_side.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

using namespace koebe;

TEST(SideBySide, does_each_piece_once)
{
    for (const int threads : {0, 1, 2, 7}) {
        for (const std::size_t count : {0UL, 1UL, 2UL, 100UL}) {
            std::vector<std::atomic<int>> times(count);
            ExecutionContext context;
            side_by_side(count, threads, context, [&](std::size_t i, ExecutionContext&) { ++times[i]; });
            for (const auto& t : times) EXPECT_EQ(t, 1);
        }
    }
}

TEST(SideBySide, throws_the_first_failure)
{
    for (int round = 0; round < 20; ++round) {
        ExecutionContext context;
        try {
            side_by_side(50, 4, context, [](std::size_t i, ExecutionContext&) {
                if (i % 10 == 7) throw InputError(std::to_string(i));
            });
            ADD_FAILURE();
        } catch (const InputError& error) {
            EXPECT_EQ(std::string(error.what()), "7");
        }
    }
}

TEST(SideBySide, a_cancel_reaches_all_threads)
{
    CancelToken token;
    ExecutionContext context({}, token);
    EXPECT_THROW(side_by_side(4, 4, context,
                              [&](std::size_t i, ExecutionContext& own) {
                                  if (i == 0) token.cancel();
                                  for (;;) {
                                      own.checkpoint();
                                      std::this_thread::yield();
                                  }
                              }),
                 Cancelled);
}

TEST(SideBySide, tells_its_progress_on_the_calling_thread)
{
    const auto caller = std::this_thread::get_id();
    double last = 0.0;
    ExecutionContext context(
        [&](double fraction, const std::string&) {
            EXPECT_EQ(std::this_thread::get_id(), caller);
            EXPECT_GE(fraction, last);
            last = fraction;
        },
        {});
    side_by_side(30, 3, context, [](std::size_t, ExecutionContext&) {});
    EXPECT_EQ(last, 1.0);
}
