// An option whose value does not fit the mesh.
#pragma once

#include <stdexcept>

namespace koebe::cli {

/// What the parser cannot know, since it takes the mesh; the exit code is that of its own errors.
class WrongUsage : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace koebe::cli
