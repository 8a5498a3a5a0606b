#include "execution/detachable_run.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

using namespace koebe;
using namespace std::chrono_literals;

TEST(DetachableRun, passes_on_the_result_and_the_progress_on_the_calling_thread)
{
    std::vector<double> fractions;
    const auto caller = std::this_thread::get_id();
    ExecutionContext context(
        [&](double fraction, const std::string& stage) {
            EXPECT_EQ(std::this_thread::get_id(), caller);
            EXPECT_EQ(stage, "work");
            fractions.push_back(fraction);
        },
        {});
    const int result = run_detachable<int>(context, [caller](ExecutionContext& own) {
        EXPECT_NE(std::this_thread::get_id(), caller);
        own.begin_stage("work", 0.0, 1.0);
        own.advance(0.5);
        return 7;
    });
    EXPECT_EQ(result, 7);
    EXPECT_EQ(fractions, (std::vector<double>{0.0, 0.5}));
}

TEST(DetachableRun, passes_on_exceptions_of_both_sides)
{
    ExecutionContext plain;
    EXPECT_THROW(run_detachable<int>(plain, [](ExecutionContext&) -> int { throw InputError("bad"); }), InputError);
    ExecutionContext throwing([](double, const std::string&) { throw std::runtime_error("stop"); }, {});
    EXPECT_THROW(run_detachable<int>(throwing,
                                     [](ExecutionContext& own) {
                                         own.advance(0.5);
                                         return 1;
                                     }),
                 std::runtime_error);
}

TEST(DetachableRun, a_cancel_is_answered_while_the_computation_does_not_ask)
{
    const auto finished = std::make_shared<std::atomic<bool>>(false);
    CancelToken token;
    ExecutionContext context({}, token);
    std::thread user([token]() mutable {
        std::this_thread::sleep_for(30ms);
        token.cancel();
    });
    EXPECT_THROW(run_detachable<int>(context,
                                     [finished](ExecutionContext&) {
                                         std::this_thread::sleep_for(2s);
                                         *finished = true;
                                         return 1;
                                     }),
                 Cancelled);
    EXPECT_FALSE(*finished);  // 2 s later it would be
    user.join();
}

TEST(DetachableRun, polls_on_the_calling_thread_while_it_waits)
{
    const auto caller = std::this_thread::get_id();
    int polls = 0;
    ExecutionContext context({}, {}, [&] {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        ++polls;
    });
    run_detachable<int>(context, [](ExecutionContext& own) {
        std::this_thread::sleep_for(200ms);
        own.advance(0.5);  // the inner context polls nothing
        return 1;
    });
    EXPECT_GE(polls, 2);
}

TEST(DetachableRun, what_the_poll_throws_leaves_it_while_the_computation_does_not_ask)
{
    const auto finished = std::make_shared<std::atomic<bool>>(false);
    ExecutionContext context({}, {}, [] { throw std::runtime_error("interrupted"); });
    EXPECT_THROW(run_detachable<int>(context,
                                     [finished](ExecutionContext&) {
                                         std::this_thread::sleep_for(2s);
                                         *finished = true;
                                         return 1;
                                     }),
                 std::runtime_error);
    EXPECT_FALSE(*finished);
}

TEST(DetachableRun, a_computation_that_was_left_holds_up_no_exit)
{
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const auto exit_while_one_runs = [] {
        CancelToken token;
        token.cancel();
        ExecutionContext context({}, token);
        try {
            run_detachable<int>(context, [](ExecutionContext&) {
                std::this_thread::sleep_for(1h);
                return 1;
            });
        } catch (const Cancelled&) {
            std::exit(7);
        }
    };
    EXPECT_EXIT(exit_while_one_runs(), testing::ExitedWithCode(7), "");
}
