// Reads the template of `koebe fit`.
#pragma once

#include "fit/circle_template.h"

#include <string>

namespace koebe::cli {

/// A JSON object: `circles` is a list, `outer` describes the rim of the unit circle and may be missing. Each circle has
/// `center` [x, y] and `radius`, and may have `name`, `loop` (all circles or none), and what rims have: `rotates`, and
/// `pin` with `vertex` and `angle` in degrees (docs/fit.md).
/// @throws FileError it cannot be read; InputError it is no such object
CircleTemplate read_template(const std::string& path);

}  // namespace koebe::cli
