// The error for an option value that does not fit the mesh.
#pragma once

#include <stdexcept>

namespace koebe::cli {

/// An error that the parser cannot find, since it depends on the mesh. It has the exit code of the parser's errors.
class WrongUsage : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace koebe::cli
