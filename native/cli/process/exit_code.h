// What the command's exit code says.
#pragma once

namespace koebe::cli {

enum ExitCode {
    done = 0,
    wrong_usage = 2,
    cannot_be_mapped = 3,  ///< one line on stderr says why; nothing is written but tables
    not_converged = 4,     ///< the files are written all the same
    interrupted = 130,     ///< 128 + SIGINT, as shells have it; nothing is written
};

}  // namespace koebe::cli
