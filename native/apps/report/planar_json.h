// Planar domains as files describe them, and the JSON report of their maps.
#pragma once

#include "core/api.h"
#include "planar_domain/planar_map.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace koebe {

/// The rims in the text of a file, JSON (docs/shapes.md) or SVG: there each closed path is a rim, and lengths are the
/// drawing's, with y upwards.
/// @throws InputError it is neither, or an entry is unknown or wrong; SVG in a build without the extra making
KOEBE_API std::vector<PlanarRim> planar_rims(const std::string& text, bool is_svg);

/// A list of places, [[x, y], ...]. @throws InputError
KOEBE_API VectorXcd planar_places(const std::string& text);
KOEBE_API nlohmann::ordered_json places_json(const VectorXcd& places);

/// {"version", "input", "converged", "error", "sweeps", "levels", "unknowns", "circles", "names", "module", "errors"}:
/// circles in the module's position, each {"rim", "center", "radius", "residual"}; "input" is empty. With slits also
/// "slits": {"kind", "error", "rims"}, each rim {"rim", "begin", "end"}, or {"rim", "radius"} of a circle round 0.
KOEBE_API nlohmann::ordered_json to_json(const PlanarResult& result);

}  // namespace koebe
