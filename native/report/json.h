// The report as JSON: one form for the command and for Python.
#pragma once

#include "core/api.h"
#include "pipeline/result.h"

#include <nlohmann/json.hpp>

#include <string>

namespace koebe {

KOEBE_API const char* to_string(Method method) noexcept;
KOEBE_API const char* to_string(Engine engine) noexcept;

/// Everything but the UVs. Vertices and faces are counted from 0; circles are in unit-disk coordinates; what is not
/// finite becomes null. "input" is empty: the front end that read a file puts its name there.
KOEBE_API nlohmann::ordered_json to_json(const UniformizeResult& result);

/// What all maps report, round the entries that one kind has for itself: version, input, vertices, faces; those;
/// converged, unless they have it in its place; the distortion, seconds, peak_memory_mb, warnings.
nlohmann::ordered_json report_json(const MapReport& map, const nlohmann::ordered_json& own);

/// The part of it that judges a map: angle_error_deg, angle_error_stored_deg, lost_area, beltrami, area_distortion,
/// conformal_energy, flipped, below_resolution (the last two as counts).
KOEBE_API nlohmann::ordered_json to_json(const Distortion& distortion);

/// Seconds of each stage by its name.
nlohmann::ordered_json to_json(const StageSeconds& seconds);

/// An array of {"kind", "elements", "text"}.
KOEBE_API nlohmann::ordered_json to_json(const std::vector<Warning>& warnings);

/// A report as the text of a file: indented, and UTF-8 whatever bytes its strings have (file names may have any; what
/// is no character becomes U+FFFD).
std::string json_text(const nlohmann::ordered_json& report);

}  // namespace koebe
