// Settings of the whole process that several calls at once need.
#pragma once

#include "core/not_copied.h"

#include <mutex>

namespace koebe {

/// While one of these lives, a Setting lives: the first one makes it, the last one destroys it, whichever thread they
/// are on. So a call that ends does not put back what another one, perhaps cancelled and left behind, still needs.
/// @tparam Setting makes its setting in its constructor and puts back what was before in its destructor
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
