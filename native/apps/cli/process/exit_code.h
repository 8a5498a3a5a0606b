// The command's exit codes.
#pragma once

namespace koebe::cli {

enum ExitCode {
    done = 0,
    wrong_usage = 2,
    cannot_be_mapped = 3,  ///< one line on stderr says why; only tables are written
    not_converged = 4,     ///< the files are written nevertheless
    interrupted = 130,     ///< 128 + SIGINT, as in shells; nothing is written
};

}  // namespace koebe::cli
