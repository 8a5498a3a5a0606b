// A batch: every file of a list mapped by a process of its own, some at a time.
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
    double stale = 120.0;  ///< seconds (Claims)
    bool writes_summary = true;
    Recipe mesh, blend;
    /// The words of the process that maps a file, the program first.
    std::function<std::vector<std::string>(const BatchFile&, const Scratch&)> command;
    /// Is given one line for every file that is settled.
    std::function<void(const std::string&)> tell;
};

struct BatchCount {
    std::size_t done = 0, not_converged = 0, failed = 0;  ///< of all files, whoever mapped them
    std::size_t lost = 0;       ///< of those that failed, what came of the machine: the next run tries them again
    std::size_t unchanged = 0;  ///< among them, those that were so before
    bool interrupted = false;
};

/// Maps every file that is not done yet (is_current), one claim and one process each. Of a file that another run has
/// claimed the result is awaited, or the claim taken over when it is dead. A file's result and then its report get
/// their names when its process has ended, so that a report says that its file is done; SIGINT, SIGTERM and SIGHUP end
/// the processes and leave what is done. Writes the summary in the end, in any case.
/// @throws FileError the output folder cannot be written, or the summary
BatchCount run_batch(const std::vector<BatchFile>& files, const BatchOptions& options);

}  // namespace koebe::batch
