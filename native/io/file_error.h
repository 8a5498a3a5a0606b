// The typed error of file system failures.
#pragma once

#include "core/errors.h"

namespace koebe {

/// A file could not be opened, read or written. A fault inside a mesh file is an InputError.
class FileError : public KoebeError {
public:
    using KoebeError::KoebeError;
    const char* name() const noexcept override { return "FileError"; }
};

}  // namespace koebe
