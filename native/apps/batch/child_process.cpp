#include "batch/child_process.h"

#include "batch/path_text.h"

#include <array>
#include <csignal>
#include <utility>

namespace koebe::batch {

std::shared_ptr<ChildProcess> ChildProcess::start(uv_loop_t& loop, const std::vector<std::string>& words,
                                                  const std::filesystem::path& log, double time_limit, Ended ended)
{
    std::shared_ptr<ChildProcess> child(new ChildProcess);
    child->self_ = child;
    child->ended_ = std::move(ended);
    child->spawn(loop, words, log);
    if (time_limit > 0.0) child->watch_time(loop, time_limit);
    return child;
}

void ChildProcess::spawn(uv_loop_t& loop, const std::vector<std::string>& words, const std::filesystem::path& log)
{
    uv_fs_t request;
    const int file = uv_fs_open(nullptr, &request, utf8(log).c_str(), UV_FS_O_WRONLY | UV_FS_O_CREAT | UV_FS_O_APPEND,
                                0666, nullptr);
    uv_fs_req_cleanup(&request);
    uv_pipe_init(&loop, &input_, 0);
    input_.data = this;
    ++open_handles_;

    std::array<uv_stdio_container_t, 3> streams{};
    streams[0].flags = static_cast<uv_stdio_flags>(UV_CREATE_PIPE | UV_READABLE_PIPE);
    streams[0].data.stream = reinterpret_cast<uv_stream_t*>(&input_);
    for (const std::size_t output : {1, 2}) {
        streams[output].flags = file < 0 ? UV_IGNORE : UV_INHERIT_FD;
        streams[output].data.fd = file;
    }
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    uv_process_options_t options{};
    options.file = arguments.front();
    options.args = arguments.data();
    options.stdio = streams.data();
    options.stdio_count = static_cast<int>(streams.size());
    options.flags = UV_PROCESS_WINDOWS_HIDE;
    options.exit_cb = [](uv_process_t* process, std::int64_t exit_status, int signal) {
        static_cast<ChildProcess*>(process->data)->end(exit_status, signal);
    };
    process_.data = this;
    begin_ = uv_hrtime();
    const int status = uv_spawn(&loop, &process_, &options);
    ++open_handles_;  // even if it failed
    if (file >= 0) {
        uv_fs_close(nullptr, &request, file, nullptr);
        uv_fs_req_cleanup(&request);
    }
    if (status == 0) return;
    close(reinterpret_cast<uv_handle_t*>(&process_));
    close(reinterpret_cast<uv_handle_t*>(&input_));
    fail("cannot start " + words.front(), status);
}

void ChildProcess::watch_time(uv_loop_t& loop, double time_limit)
{
    uv_timer_init(&loop, &timer_);
    timer_.data = this;
    ++open_handles_;
    const auto out_of_time = [](uv_timer_t* timer) {
        auto* const child = static_cast<ChildProcess*>(timer->data);
        child->timed_out_ = true;
        child->kill(SIGKILL);
    };
    uv_timer_start(&timer_, out_of_time, static_cast<std::uint64_t>(1000.0 * time_limit), 0);
}

void ChildProcess::end(std::int64_t exit_status, int signal)
{
    const double seconds = 1e-9 * static_cast<double>(uv_hrtime() - begin_);
    close(reinterpret_cast<uv_handle_t*>(&process_));
    close(reinterpret_cast<uv_handle_t*>(&input_));
    if (timer_.data != nullptr) close(reinterpret_cast<uv_handle_t*>(&timer_));
    // A process may have ended by itself just at the limit.
    const bool timed_out = timed_out_ && (signal != 0 || exit_status != 0);
    std::exchange(ended_, nullptr)({exit_status, signal, timed_out, seconds});
}

void ChildProcess::close(uv_handle_t* handle)
{
    uv_close(handle, [](uv_handle_t* closed) {
        auto* const child = static_cast<ChildProcess*>(closed->data);
        if (--child->open_handles_ == 0) const auto last = std::move(child->self_);
    });
}

}  // namespace koebe::batch
