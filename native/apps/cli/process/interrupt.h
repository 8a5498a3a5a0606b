// Ctrl-C and termination signals stop the computation at its next checkpoint.
#pragma once

#include "execution/execution.h"

namespace koebe::cli {

/// A token that SIGINT, SIGTERM and SIGHUP raise. A second signal ends the process at once. A file that gets too large
/// or a closed pipe gives a FileError instead of a signal.
CancelToken cancel_on_signal();

}  // namespace koebe::cli
