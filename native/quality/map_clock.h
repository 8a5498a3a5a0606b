// The seconds that a map's stages take, and how a map ends.
#pragma once

#include "execution/execution.h"
#include "execution/peak_memory.h"
#include "execution/stopwatch.h"
#include "quality/report.h"

namespace koebe {

class MapClock {
public:
    /// What has passed since the last stage ended is of this one.
    void end(double StageSeconds::*stage) { seconds_.*stage += stage_.lap(); }
    /// What others have measured since then.
    void take(const StageSeconds& seconds)
    {
        seconds_ += seconds;
        stage_.lap();
    }

    /// The last stage, the total, the memory; the progress is whole.
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
