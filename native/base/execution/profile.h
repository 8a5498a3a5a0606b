// Where a run's time goes: the stages of its threads, as a flame graph shows them.
#pragma once

#include "core/api.h"
#include "core/not_copied.h"

#include <string>

namespace koebe {

namespace detail {

struct StageNode;

/// The stage that this thread is in; null if no profile is taken of it.
KOEBE_API StageNode* stage_here() noexcept;

}  // namespace detail

/// A stage of this thread's work, inside the stage that the thread was in. Without a profile it costs one call. The
/// profile leaves out "wait", a stage in which a thread waits for others.
class ProfiledStage {
public:
    ProfiledStage() = default;
    explicit ProfiledStage(const char* name) { begin(name); }
    ProfiledStage(const ProfiledStage&) noexcept {}  // a copy has no stage
    // NOLINTNEXTLINE(bugprone-unhandled-self-assignment): an assignment changes nothing
    ProfiledStage& operator=(const ProfiledStage&) noexcept { return *this; }
    ~ProfiledStage()
    {
        if (own_ != nullptr) end();
    }

    /// Ends this object's stage, with all stages inside it, and begins another one.
    void begin(const std::string& name)
    {
        if (detail::stage_here() != nullptr) enter(name);
    }

private:
    KOEBE_API void enter(const std::string& name);
    KOEBE_API void end() noexcept;

    detail::StageNode* own_ = nullptr;
};

/// A thread that works for another one: its time belongs to the other one's stage.
class ProfiledThread : NotCopied {
public:
    /// @param stage of the other thread
    KOEBE_API explicit ProfiledThread(detail::StageNode* stage) noexcept;
    KOEBE_API ~ProfiledThread();
};

/// Begins the only profile of this process, on this thread. @param name of the whole
KOEBE_API void take_profile(const std::string& name);

/// A line for each stage: the names of the stages around it and its own, joined by semicolons, and the microseconds of
/// all threads in it and in no stage inside it. Tools for flame graphs read this.
KOEBE_API std::string folded_profile();

}  // namespace koebe
