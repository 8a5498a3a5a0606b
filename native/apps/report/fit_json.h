// The JSON report of a map to a template.
#pragma once

#include "core/api.h"
#include "fit/fit_circles.h"

#include <nlohmann/json.hpp>

namespace koebe {

/// The report of to_json(UniformizeResult). Each loop also has its rank and, if there are names, its name; "fit" has
/// the figures of the bending.
KOEBE_API nlohmann::ordered_json to_json(const FitResult& result);

}  // namespace koebe
