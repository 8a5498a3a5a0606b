#include "files/file_error.h"

namespace koebe::io {

void fail(const std::string& what, const std::error_code& reason)
{
    const std::string message = what + " (" + reason.message() + ")";
    if (reason == std::errc::not_enough_memory) throw OutOfMemory(message);
    throw FileError(message);
}

void fail(const std::string& what, int error_number) { fail(what, {error_number, std::generic_category()}); }

}  // namespace koebe::io
