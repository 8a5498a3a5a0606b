// The report as Python objects.
#pragma once

#include <nlohmann/json.hpp>
#include <pybind11/pytypes.h>

namespace koebe::python {

/// Dicts, lists, strings, numbers and booleans; None for a number that is not finite, as in the text of the JSON.
pybind11::object to_object(const nlohmann::ordered_json& report);

}  // namespace koebe::python
