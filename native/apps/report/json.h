// The JSON report, in one form for the command and for Python.
#pragma once

#include "circles/mapped_loop.h"
#include "core/api.h"
#include "pipeline/result.h"
#include "quality/report.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace koebe {

KOEBE_API const char* to_string(Method method) noexcept;
KOEBE_API const char* to_string(Engine engine) noexcept;

/// Everything but the UVs. Vertices and faces are counted from 0; circles are in unit-disk coordinates; numbers that
/// are not finite become null. "input" is empty: the front end that read the file puts the file's name there.
KOEBE_API nlohmann::ordered_json to_json(const UniformizeResult& result);

/// The report of every map, around its own entries: version, input, vertices, faces; own entries; converged, unless
/// these have it; the distortion, seconds, peak_memory_mb, warnings.
nlohmann::ordered_json report_json(const MapReport& map, const nlohmann::ordered_json& own);
/// The own entries begin with converged, sweeps and changes.
nlohmann::ordered_json report_json(const SweptMapReport& map, const nlohmann::ordered_json& own);

/// {"center": [x, y], "radius"}
nlohmann::ordered_json to_json(const Circle& circle);
/// {"roundness", "roundness_least_squares"}
nlohmann::ordered_json to_json(const Roundness& roundness);
/// vertices, the circle, roundness, off_circle
nlohmann::ordered_json loop_json(const MappedLoop& loop, const nlohmann::ordered_json& circle);

template <typename T>
nlohmann::ordered_json array_json(const std::vector<T>& items, nlohmann::ordered_json (*item_json)(const T&))
{
    nlohmann::ordered_json array = nlohmann::ordered_json::array();
    for (const T& item : items) array.push_back(item_json(item));
    return array;
}

/// The report's part that judges a map: angle_error_deg, angle_error_stored_deg, lost_area, beltrami, area_distortion,
/// conformal_energy, flipped, below_resolution (the last two as counts).
KOEBE_API nlohmann::ordered_json to_json(const Distortion& distortion);

/// The seconds of each stage under its name.
nlohmann::ordered_json to_json(const StageSeconds& seconds);

/// An array of {"kind", "elements", "text"}.
KOEBE_API nlohmann::ordered_json to_json(const std::vector<Warning>& warnings);

/// The text of a report's file: indented UTF-8. Strings may hold any bytes, as file names do; bytes that are not a
/// character become U+FFFD.
std::string json_text(const nlohmann::ordered_json& report);

}  // namespace koebe
