#include "batch/batch_run.h"

#include "batch/child_process.h"
#include "batch/claim.h"
#include "batch/content_hash.h"
#include "batch/path_text.h"
#include "batch/process_outcome.h"
#include "batch/summary.h"
#include "core/counted.h"
#include "exit_code.h"
#include "files/file_error.h"

#include <uv.h>

#include <array>
#include <csignal>
#include <deque>
#include <list>
#include <optional>
#include <sstream>
#include <utility>

namespace koebe::batch {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t look_ms = 500;       // another run's claim is looked at in this interval
constexpr std::uint64_t patience_ms = 5000;  // for a process that was asked to end
constexpr std::uint64_t grace_ms = 300;      // time in which the signal that ended a process may reach this one
constexpr std::uint64_t turn_ns = 50000000;  // time for files without a process, before signals are looked at again

/// Whether the caller has a signal ignored, as nohup does.
bool is_ignored(int signal)
{
#ifdef _WIN32
    if (signal == SIGHUP) return false;  // the C library does not know it there
#endif
    const auto before = std::signal(signal, SIG_IGN);
    if (before != SIG_ERR) std::signal(signal, before);
    return before == SIG_IGN;
}

class Run {
public:
    Run(const std::vector<BatchFile>& files, const BatchOptions& options)
        : options_(options), claims_(options.output / work_folder, options.stale), total_(files.size())
    {
        for (const BatchFile& file : files) waiting_.push_back({&file, {}, false});
    }

    BatchCount run()
    {
        uv_loop_init(&loop_);
        try {
            watch();
            start_some();
            uv_run(&loop_, UV_RUN_DEFAULT);
        } catch (...) {
            failure_ = std::current_exception();
        }
        close();
        try {
            if (!failure_ && options_.writes_summary) write_summary(options_.output, claims_);
        } catch (...) {
            failure_ = std::current_exception();
        }
        claims_.clean_up();
        if (failure_) std::rethrow_exception(failure_);
        return count_;
    }

private:
    struct Waiting {
        const BatchFile* file;
        std::string hash;  ///< of its bytes, once they were read
        bool elsewhere;    ///< whether another run has it
    };

    struct Task : ClaimedFile {
        std::shared_ptr<ChildProcess> process = nullptr;
    };

    // ------------------------------------------------------------------ the loop

    template <typename Handle>
    static Run& of(Handle* handle)
    {
        return *static_cast<Run*>(handle->data);
    }

    /// Calls a part of the run from C, which no exception may pass through.
    template <typename Part>
    void guarded(Part&& part) noexcept
    {
        try {
            part();
        } catch (...) {
            if (!failure_) failure_ = std::current_exception();
            stop();
        }
    }

    void watch()
    {
        for (uv_timer_t* timer : timers_) {
            uv_timer_init(&loop_, timer);
            timer->data = this;
        }
        for (uv_timer_t* timer : {&beat_, &patience_}) uv_unref(reinterpret_cast<uv_handle_t*>(timer));
        uv_timer_start(
            &beat_, [](uv_timer_t* timer) { of(timer).beat(); }, Claims::beat_ms, Claims::beat_ms);
        constexpr std::array numbers{SIGINT, SIGTERM, SIGHUP};
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            uv_signal_init(&loop_, &signals_[i]);
            signals_[i].data = this;
            uv_unref(reinterpret_cast<uv_handle_t*>(&signals_[i]));
            if (!is_ignored(numbers[i]))
                uv_signal_start(
                    &signals_[i], [](uv_signal_t* signal, int) { of(signal).interrupt(); }, numbers[i]);
        }
    }

    void beat() noexcept
    {
        for (const Task& task : tasks_) task.claim.beat();
    }

    /// Asks the processes to end; kills them at a second signal, or if they do not end in time.
    void interrupt() noexcept
    {
        count_.interrupted = true;
        const bool again = stopping_;
        stop();
        if (again) kill_all(SIGKILL);
    }

    void stop() noexcept
    {
        if (std::exchange(stopping_, true)) return;
        waiting_.clear();
        uv_timer_stop(&look_);
        uv_timer_stop(&grace_);
        kill_all(SIGTERM);
        uv_timer_start(
            &patience_, [](uv_timer_t* timer) { of(timer).kill_all(SIGKILL); }, patience_ms, patience_ms);
    }

    void kill_all(int signal) noexcept
    {
        for (const Task& task : tasks_)
            if (task.process) task.process->kill(signal);
    }

    void close()
    {
        stop();
        kill_all(SIGKILL);
        uv_run(&loop_, UV_RUN_DEFAULT);  // waits for the processes to end
        for (Task& task : killed_) remove_scratch(task);
        for (uv_timer_t* timer : timers_)
            if (timer->data != nullptr) uv_close(reinterpret_cast<uv_handle_t*>(timer), nullptr);
        for (uv_signal_t& signal : signals_)
            if (signal.data != nullptr) uv_close(reinterpret_cast<uv_handle_t*>(&signal), nullptr);
        uv_run(&loop_, UV_RUN_DEFAULT);
        uv_loop_close(&loop_);
    }

    // ------------------------------------------------------------------ files

    const Recipe& recipe(const BatchFile& file) const { return file.is_blend ? options_.blend : options_.mesh; }

    /// Settles finished files, and starts processes in free places. Files of other runs go to the end of the queue.
    void start_some()
    {
        const std::uint64_t begin = uv_hrtime();
        bool any_elsewhere = false, is_turn_over = false;
        for (std::size_t looks = waiting_.size(); looks > 0 && has_place() && !is_turn_over; --looks) {
            Waiting next = std::move(waiting_.front());
            waiting_.pop_front();
            if (!settle_or_start(next)) {
                any_elsewhere = true;
                waiting_.push_back(std::move(next));
            }
            is_turn_over = uv_hrtime() - begin > turn_ns;
        }
        if (has_place() && !waiting_.empty() && (any_elsewhere || is_turn_over))
            uv_timer_start(
                &look_, [](uv_timer_t* look) { of(look).guarded([look] { of(look).start_some(); }); },
                is_turn_over ? 0 : look_ms, 0);
    }

    bool has_place() const { return !stopping_ && tasks_.size() + killed_.size() < options_.workers; }

    /// @return false if another run has the file
    bool settle_or_start(Waiting& next)
    {
        const BatchFile& file = *next.file;
        Json unreadable;
        try {
            if (next.hash.empty()) next.hash = sha256_of_file(file.source);
        } catch (const FileError& error) {
            unreadable = {{"name", "FileError"}, {"reason", error.what()}};
        }
        if (settle_known(next)) return true;
        std::optional<Claims::Claim> claim = claims_.take(file.name);
        if (!claim) {
            next.elsewhere = true;
            return false;
        }
        if (settle_known(next)) {  // done since the last look
            claim->release();
            return true;
        }
        if (!unreadable.is_null()) {
            settle(keep_failure({&file, {}, *claim, {}, {}}, recipe(file), unreadable));
            claim->release();
            return true;
        }
        start(file, next.hash, std::move(*claim));
        return true;
    }

    bool settle_known(const Waiting& next)
    {
        const auto report = read_report(next.file->report);
        if (!report || !is_current(*report, *next.file, next.hash, recipe(*next.file))) return false;
        if (!next.elsewhere) ++count_.unchanged;
        settle(*report, next.elsewhere ? "done by another run" : "unchanged");
        return true;
    }

    void start(const BatchFile& file, const std::string& hash, Claims::Claim claim)
    {
        tasks_.push_back({{&file, hash, std::move(claim), {}, {}}});
        const auto task = std::prev(tasks_.end());
        task->scratch = make_scratch(file, task->claim);
        try {
            task->process = ChildProcess::start(
                loop_, options_.command(file, task->scratch), task->scratch.log, recipe(file).time_limit,
                [this, task](const ProcessEnd& end) { guarded([&] { finish(task, end); }); });
        } catch (...) {
            task->claim.release();
            tasks_.erase(task);
            throw;
        }
    }

    void finish(std::list<Task>::iterator ended, const ProcessEnd& end)
    {
        Task task = std::move(*ended);
        tasks_.erase(ended);
        task.process.reset();
        task.end = end;
        if (is_killed(end) && !stopping_) {  // perhaps this process gets the same signal soon: Ctrl-C goes to all
            killed_.push_back(std::move(task));
            uv_timer_start(
                &grace_, [](uv_timer_t* grace) { of(grace).guarded([grace] { of(grace).settle_killed(); }); }, grace_ms,
                0);
            return;
        }
        settle_end(task);
        if (!stopping_) start_some();
    }

    void settle_killed()
    {
        for (; !killed_.empty(); killed_.pop_front()) settle_end(killed_.front());
        start_some();
    }

    void settle_end(Task& task)
    {
        const Recipe& of_file = recipe(*task.file);
        try {
            // While this run ends, a file counts only if it was finished.
            if (!task.claim.is_held()) {
                if (!stopping_) waiting_.push_back({task.file, task.hash, true});
            } else if (is_mapped(task.end)) {
                settle(keep_result(task, of_file, options_.output));
            } else if (!stopping_) {
                const Scratch& scratch = task.scratch;
                const Json error = error_of(task.end, scratch.report, scratch.log, of_file.time_limit);
                settle(keep_failure(task, of_file, error));
            }
        } catch (...) {
            remove_scratch(task);
            throw;
        }
        remove_scratch(task);
    }

    void settle(const Json& report) { settle(report, report.contains("error") ? "failed" : "done"); }

    /// Counts a file and reports it.
    void settle(const Json& report, const std::string& how)
    {
        const Json error = report.contains("error") ? report["error"] : Json();
        const int code = report["exit_code"].get<int>();
        ++(error.is_object() ? count_.failed : code == not_converged ? count_.not_converged : count_.done);
        std::ostringstream line;
        line << '[' << count_.done + count_.not_converged + count_.failed << '/' << total_ << "] "
             << report["name"].get<std::string>() << ": " << how;
        if (error.is_object() && !is_lasting(error, {{}, 0.0, false}) && error_name(error) != "TimeLimit")
            ++count_.lost;
        if (code == not_converged) line << ", not converged";
        if (error.is_object())
            line << ", " << error_name(error) << ": " << error.value("reason", "");
        else if (const Json seconds = summary_row(report)["seconds"]; seconds.is_number())
            line << ", " << formatted("%.1f s", seconds.get<double>());
        options_.tell(line.str());
    }

    const BatchOptions& options_;
    Claims claims_;
    std::size_t total_;
    BatchCount count_;
    std::deque<Waiting> waiting_;
    std::list<Task> tasks_;
    std::deque<Task> killed_;  ///< from outside
    std::exception_ptr failure_;
    bool stopping_ = false;
    uv_loop_t loop_{};
    uv_timer_t beat_{}, look_{}, grace_{}, patience_{};
    const std::array<uv_timer_t*, 4> timers_{&beat_, &look_, &grace_, &patience_};
    std::array<uv_signal_t, 3> signals_{};
};

}  // namespace

BatchCount run_batch(const std::vector<BatchFile>& files, const BatchOptions& options)
{
    std::error_code error;
    std::filesystem::create_directories(options.output, error);
    if (error) io::fail("cannot write " + utf8(options.output), error);
    return Run(files, options).run();
}

}  // namespace koebe::batch
