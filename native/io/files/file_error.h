// The typed error of file system failures.
#pragma once

#include "core/errors.h"

#include <string>
#include <system_error>

namespace koebe {

/// A file could not be opened, read or written. A fault inside a mesh file is an InputError.
class FileError : public KoebeError {
public:
    using KoebeError::KoebeError;
    const char* name() const noexcept override { return "FileError"; }
};

namespace io {

/// Ends what could not be done with a file, and tells the system's reason: "`what` (reason)".
/// @throws OutOfMemory if the system had too little memory for it, FileError otherwise
[[noreturn]] void fail(const std::string& what, const std::error_code& reason);

/// The same, for a reason that is a value of errno.
[[noreturn]] void fail(const std::string& what, int error_number);

}  // namespace io
}  // namespace koebe
