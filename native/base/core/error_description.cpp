#include "core/error_description.h"

namespace koebe {

std::optional<ErrorDescription> describe_error_of_library(const std::exception_ptr& pointer)
{
    return describe_error(pointer);
}

}  // namespace koebe
