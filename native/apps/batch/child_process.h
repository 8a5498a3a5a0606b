// A process of a batch: starts it, times it, ends it.
#pragma once

#include <uv.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace koebe::batch {

struct ProcessEnd {
    std::int64_t exit_status = 0;
    int signal = 0;  ///< the signal that ended it, or 0
    bool timed_out = false;
    double seconds = 0.0;
};

/// A process on a loop of libuv. Its standard input is a pipe without data, which closes when this process ends in any
/// way. So a child that watches it does not outlive this process. Its output goes to a file.
class ChildProcess {
public:
    using Ended = std::function<void(const ProcessEnd&)>;

    /// @param words the program and its arguments
    /// @param log file for its standard output and error
    /// @param time_limit seconds until it is killed; 0: no limit
    /// @param ended called once, on the loop, when the process has ended
    /// @throws FileError it cannot be started
    static std::shared_ptr<ChildProcess> start(uv_loop_t& loop, const std::vector<std::string>& words,
                                               const std::filesystem::path& log, double time_limit, Ended ended);

    void kill(int signal) noexcept { uv_process_kill(&process_, signal); }

private:
    ChildProcess() = default;
    void spawn(uv_loop_t& loop, const std::vector<std::string>& words, const std::filesystem::path& log);
    void watch_time(uv_loop_t& loop, double time_limit);
    void end(std::int64_t exit_status, int signal);
    void close(uv_handle_t* handle);

    uv_process_t process_{};
    uv_pipe_t input_{};
    uv_timer_t timer_{};
    Ended ended_;
    std::uint64_t begin_ = 0;  ///< nanoseconds
    bool timed_out_ = false;
    int open_handles_ = 0;
    std::shared_ptr<ChildProcess> self_;  ///< while the loop uses its handles
};

}  // namespace koebe::batch
