// Settings of the whole process that several concurrent calls need.
#pragma once

#include "core/not_copied.h"

#include <mutex>

namespace koebe {

/// Keeps a Setting alive as long as any ProcessSetting lives. The first one makes the Setting and the last one destroys
/// it, on whichever thread. So a call that ends does not undo a setting that another call still needs.
/// @tparam Setting makes its setting in its constructor and restores the former one in its destructor
template <typename Setting>
class ProcessSetting : NotCopied {
public:
    ProcessSetting()
    {
        const std::scoped_lock lock(mutex_);
        if (users_ == 0) setting_ = new Setting;
        ++users_;
    }
    ~ProcessSetting()
    {
        const std::scoped_lock lock(mutex_);
        if (--users_ > 0) return;
        delete setting_;
        setting_ = nullptr;
    }

private:
    static inline std::mutex mutex_;
    static inline int users_ = 0;
    static inline Setting* setting_ = nullptr;
};

}  // namespace koebe
