// Progress on stderr, if a person is looking.
#pragma once

#include "core/not_copied.h"
#include "execution/execution.h"

#include <string>

namespace koebe::cli {

/// One line that is drawn over and over, and gone when the object is. Nothing at all if stderr is no terminal.
class ProgressLine : NotCopied {
public:
    explicit ProgressLine(bool quiet);
    ~ProgressLine() { clear(); }

    /// For an ExecutionContext; refers to this object. Empty if nothing is to be shown.
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
