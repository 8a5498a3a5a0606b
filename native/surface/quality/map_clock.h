// Measures the seconds of a map's stages, and finishes its report.
#pragma once

#include "execution/execution.h"
#include "execution/peak_memory.h"
#include "execution/stopwatch.h"
#include "quality/report.h"

namespace koebe {

class MapClock {
public:
    /// Adds the time since the last stage ended to this stage.
    void end(double StageSeconds::*stage) { seconds_.*stage += stage_.lap(); }
    /// Adds seconds that others measured since the last stage ended.
    void take(const StageSeconds& seconds)
    {
        seconds_ += seconds;
        stage_.lap();
    }

    /// Ends the last stage; reports total and memory; completes the progress.
    void finish(MapReport& report, ExecutionContext& context)
    {
        end(&StageSeconds::finish);
        seconds_.total = total_.elapsed();
        report.seconds = seconds_;
        report.peak_memory_mb = peak_memory_mb();
        context.advance(1.0);
    }

private:
    Stopwatch total_, stage_;
    StageSeconds seconds_;
};

}  // namespace koebe
