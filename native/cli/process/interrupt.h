// Ctrl-C and a polite kill stop the computation at its next checkpoint.
#pragma once

#include "execution/execution.h"

namespace koebe::cli {

/// A token that SIGINT, SIGTERM and SIGHUP raise. A second signal ends the process at once. Writing too much or to a
/// closed pipe becomes a FileError instead of a signal.
CancelToken cancel_on_signal();

}  // namespace koebe::cli
