#include "cli/process/progress_line.h"

#include "cli/process/standard_streams.h"

#include <cstdio>

namespace koebe::cli {

ProgressLine::ProgressLine(bool quiet) : active_(!quiet && is_error_shown()) {}

ProgressCallback ProgressLine::callback()
{
    if (!active_) return {};
    return [this](double fraction, const std::string& stage) { show(fraction, stage); };
}

void ProgressLine::show(double fraction, const std::string& stage)
{
    const int percent = static_cast<int>(100.0 * fraction);
    if (percent == last_percent_ && stage == last_stage_) return;
    last_percent_ = percent;
    last_stage_ = stage;
    shown_ = true;
    std::fprintf(stderr, "\r\033[K%3d%% %s", percent, stage.c_str());  // start of line, erase to its end
    std::fflush(stderr);
}

void ProgressLine::clear()
{
    if (shown_) std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    shown_ = false;
}

}  // namespace koebe::cli
