// Converts the report to Python objects.
#pragma once

#include <nlohmann/json.hpp>
#include <pybind11/pytypes.h>

namespace koebe::python {

/// Dicts, lists, strings, numbers and booleans. A number that is not finite becomes None, as in the JSON text.
pybind11::object to_object(const nlohmann::ordered_json& report);

}  // namespace koebe::python
