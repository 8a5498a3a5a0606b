#include "execution/profile.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace koebe {

/// A stage inside certain others. It lives as long as the process.
struct detail::StageNode {
    std::string name;
    StageNode* around = nullptr;
    std::atomic<std::int64_t> nanoseconds{0};
    std::vector<std::unique_ptr<StageNode>> inside;
};

namespace {

using detail::StageNode;
using ProfileClock = std::chrono::steady_clock;

/// The whole, and the lock of all lists of stages.
struct ProfileTree {
    StageNode whole;
    std::mutex mutex;
};

ProfileTree& profile_tree()
{
    static ProfileTree& tree = *new ProfileTree;  // threads may outlive main
    return tree;
}

thread_local StageNode* stage_now = nullptr;
thread_local ProfileClock::time_point stage_since;

/// Gives the time since the last change to the stage that this thread leaves.
void change_stage(StageNode* next) noexcept
{
    const ProfileClock::time_point now = ProfileClock::now();
    if (stage_now != nullptr)
        stage_now->nanoseconds += std::chrono::duration_cast<std::chrono::nanoseconds>(now - stage_since).count();
    stage_since = now;
    stage_now = next;
}

StageNode* stage_inside(StageNode& around, const std::string& name)
{
    const std::scoped_lock lock(profile_tree().mutex);
    for (const auto& stage : around.inside)
        if (stage->name == name) return stage.get();
    around.inside.push_back(std::make_unique<StageNode>());
    around.inside.back()->name = name;
    around.inside.back()->around = &around;
    return around.inside.back().get();
}

void fold(const StageNode& stage, const std::string& around, std::string& lines)
{
    if (stage.name == "wait") return;
    const std::string names = around + stage.name;
    if (const std::int64_t microseconds = (stage.nanoseconds + 500) / 1000; microseconds > 0)
        lines += names + " " + std::to_string(microseconds) + "\n";
    for (const auto& inner : stage.inside) fold(*inner, names + ";", lines);
}

}  // namespace

StageNode* detail::stage_here() noexcept { return stage_now; }

void ProfiledStage::enter(const std::string& name)
{
    end();
    own_ = stage_inside(*stage_now, name);
    change_stage(own_);
}

/// A stage that an earlier end has already left stays ended.
void ProfiledStage::end() noexcept
{
    const StageNode* const ended = own_;
    own_ = nullptr;
    for (const StageNode* stage = stage_now; stage != nullptr && ended != nullptr; stage = stage->around)
        if (stage == ended) return change_stage(ended->around);
}

ProfiledThread::ProfiledThread(StageNode* stage) noexcept { change_stage(stage); }
ProfiledThread::~ProfiledThread() { change_stage(nullptr); }

void take_profile(const std::string& name)
{
    profile_tree().whole.name = name;
    change_stage(&profile_tree().whole);
}

std::string folded_profile()
{
    change_stage(stage_now);
    const std::scoped_lock lock(profile_tree().mutex);
    std::string lines;
    fold(profile_tree().whole, "", lines);
    return lines;
}

}  // namespace koebe
