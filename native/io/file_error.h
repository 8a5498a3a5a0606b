// The typed error of the file system's failures.
#pragma once

#include "core/errors.h"

namespace koebe {

/// A file that could not be opened, read or written; what is wrong inside a mesh file is an InputError.
class FileError : public KoebeError {
public:
    using KoebeError::KoebeError;
    const char* name() const noexcept override { return "FileError"; }
};

}  // namespace koebe
