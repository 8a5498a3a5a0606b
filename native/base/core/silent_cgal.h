// CGAL without output.
#pragma once

#include "core/not_copied.h"
#include "core/process_setting.h"

#include <CGAL/assertions_behaviour.h>

namespace koebe {

/// CGAL prints failed checks and then throws. While this lives it only throws.
class CgalHandlersIgnored : NotCopied {
public:
    CgalHandlersIgnored() : error_(CGAL::set_error_handler(ignore)), warning_(CGAL::set_warning_handler(ignore)) {}
    ~CgalHandlersIgnored()
    {
        CGAL::set_error_handler(error_);
        CGAL::set_warning_handler(warning_);
    }

private:
    static void ignore(const char*, const char*, const char*, int, const char*) {}
    CGAL::Failure_function error_, warning_;
};

using SilentCgal = ProcessSetting<CgalHandlersIgnored>;

}  // namespace koebe
