// Shows progress on stderr, if stderr is a terminal.
#pragma once

#include "core/not_copied.h"
#include "execution/execution.h"

#include <string>

namespace koebe::cli {

/// One line that is redrawn, and erased with the object.
class ProgressLine : NotCopied {
public:
    explicit ProgressLine(bool quiet);
    ~ProgressLine() { clear(); }

    /// For an ExecutionContext; refers to this object. Empty if nothing is shown.
    ProgressCallback callback();

private:
    void show(double fraction, const std::string& stage);
    void clear();

    bool shown_ = false;
    bool active_;
    int last_percent_ = -1;
    std::string last_stage_;
};

}  // namespace koebe::cli
