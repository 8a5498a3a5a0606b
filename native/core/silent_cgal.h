// CGAL without output.
#pragma once

#include <CGAL/assertions_behaviour.h>

namespace koebe {

/// CGAL reports failed checks by printing, and then throws: while one of these lives it only throws.
class SilentCgal {
public:
    SilentCgal() : error_(CGAL::set_error_handler(ignore)), warning_(CGAL::set_warning_handler(ignore)) {}
    ~SilentCgal()
    {
        CGAL::set_error_handler(error_);
        CGAL::set_warning_handler(warning_);
    }
    SilentCgal(const SilentCgal&) = delete;
    SilentCgal& operator=(const SilentCgal&) = delete;

private:
    static void ignore(const char*, const char*, const char*, int, const char*) {}
    CGAL::Failure_function error_, warning_;
};

}  // namespace koebe
