// Seconds of the stages of a run.
#pragma once

#include <chrono>

namespace koebe {

class Stopwatch {
public:
    double elapsed() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }
    /// Seconds since the last lap.
    double lap()
    {
        const double seconds = elapsed();
        begin_ = Clock::now();
        return seconds;
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point begin_ = Clock::now();
};

}  // namespace koebe
