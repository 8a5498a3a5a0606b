// Progress and cancellation: the object passed through every long computation.
#pragma once

#include "core/errors.h"
#include "execution/profile.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace koebe {

/// A flag that any thread may raise; the computation polls it at every checkpoint.
class CancelToken {
public:
    void cancel() noexcept { flag_->store(true, std::memory_order_relaxed); }
    bool cancelled() const noexcept { return flag_->load(std::memory_order_relaxed); }

private:
    std::shared_ptr<std::atomic<bool>> flag_ = std::make_shared<std::atomic<bool>>(false);
};

/// Called on the calling thread with a fraction in [0, 1], which never falls, and the stage's name.
using ProgressCallback = std::function<void(double fraction, const std::string& stage)>;

/// Called on the calling thread at every checkpoint, about every 20 ms in run_detachable. Its exceptions end the call.
using PollCallback = std::function<void()>;

class ExecutionContext {
public:
    ExecutionContext() = default;
    ExecutionContext(ProgressCallback progress, CancelToken token, PollCallback poll = {})
        : progress_(std::move(progress)), token_(std::move(token)), poll_(std::move(poll))
    {
    }

    /// Throws Cancelled if the token was raised.
    void checkpoint() const
    {
        if (poll_) poll_();
        if (token_.cancelled()) throw Cancelled();
    }

    /// Reports progress within the current stage, then checks for cancellation.
    /// @param fraction in [0, 1] of the stage opened by begin_stage
    void advance(double fraction)
    {
        if (progress_) {
            const double overall = begin_ + (end_ - begin_) * std::clamp(fraction, 0.0, 1.0);
            reported_ = std::max(reported_, overall);
            progress_(reported_, stage_);
        }
        checkpoint();
    }

    /// Passes on another context's report on the whole.
    void report(double overall, const std::string& stage) { show_stage(stage, overall, overall); }

    /// Opens a stage that covers [begin, end] of the whole.
    void begin_stage(std::string stage, double begin, double end)
    {
        profiled_.begin(stage);
        show_stage(std::move(stage), begin, end);
    }

private:
    void show_stage(std::string stage, double begin, double end)
    {
        stage_ = std::move(stage);
        begin_ = begin;
        end_ = end;
        advance(0.0);
    }

    ProgressCallback progress_;
    CancelToken token_;
    PollCallback poll_;
    std::string stage_;
    ProfiledStage profiled_;
    double begin_ = 0.0;
    double end_ = 1.0;
    double reported_ = 0.0;
};

}  // namespace koebe
