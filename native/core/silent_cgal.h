// CGAL without output.
#pragma once

#include <CGAL/assertions_behaviour.h>

#include <mutex>

namespace koebe {

/// CGAL reports failed checks by printing, and then throws: while one of these lives it only throws. Its handlers are
/// those of all threads: the first one of these takes them, and the last one gives them back.
class SilentCgal {
public:
    SilentCgal()
    {
        const std::scoped_lock lock(mutex_);
        if (alive_++ > 0) return;
        error_ = CGAL::set_error_handler(ignore);
        warning_ = CGAL::set_warning_handler(ignore);
    }
    ~SilentCgal()
    {
        const std::scoped_lock lock(mutex_);
        if (--alive_ > 0) return;
        CGAL::set_error_handler(error_);
        CGAL::set_warning_handler(warning_);
    }
    SilentCgal(const SilentCgal&) = delete;
    SilentCgal& operator=(const SilentCgal&) = delete;

private:
    static void ignore(const char*, const char*, const char*, int, const char*) {}
    static inline std::mutex mutex_;
    static inline int alive_ = 0;
    static inline CGAL::Failure_function error_ = nullptr, warning_ = nullptr;
};

}  // namespace koebe
