// A batch: maps every file of a list by a process of its own, several at a time.
#pragma once

#include "batch/file_list.h"
#include "batch/file_report.h"
#include "batch/file_result.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace koebe::batch {

// NOLINTNEXTLINE(bugprone-exception-escape): JSON is moved without exceptions, by functions that could throw some
struct BatchOptions {
    std::filesystem::path output;  ///< the folder
    unsigned workers = 1;
    double stale = 120.0;  ///< seconds after which another host's claim is dead (Claims)
    bool writes_summary = true;
    Recipe mesh, blend;
    /// The command line of the process that maps a file, program first.
    std::function<std::vector<std::string>(const BatchFile&, const Scratch&)> command;
    /// Called with one line for every file that is settled.
    std::function<void(const std::string&)> tell;
};

struct BatchCount {
    std::size_t done = 0, not_converged = 0, failed = 0;  ///< of all files, including other runs' files
    std::size_t lost = 0;       ///< failures caused by the machine: the next run tries these files again
    std::size_t unchanged = 0;  ///< files that a former run had already settled
    bool interrupted = false;
};

/// Maps every file that is not done yet (is_current), with one claim and one process each. If another run has claimed a
/// file, waits for its result, or takes over a dead claim. A file's result and then its report get their names when its
/// process has ended, so the report proves that the file is done. SIGINT, SIGTERM and SIGHUP end the processes and keep
/// finished files. Always writes the summary at the end.
/// @throws FileError the output folder or the summary cannot be written
BatchCount run_batch(const std::vector<BatchFile>& files, const BatchOptions& options);

}  // namespace koebe::batch
