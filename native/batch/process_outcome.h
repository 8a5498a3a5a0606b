// What the process of a file has come to: how it ended, and what it has said of that.
#pragma once

#include "batch/child_process.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace koebe::batch {

/// Of a map that was made, but is not what was asked for.
inline constexpr int not_converged_code = 4;

/// Whether it made a map, converged or not.
bool is_mapped(const ProcessEnd& end);

/// Whether something else ended it than itself or the time limit.
bool is_killed(const ProcessEnd& end);

/// What a process reports of itself, or an empty object.
nlohmann::ordered_json own_report(const std::filesystem::path& report);

/// The error of a process that made no map: its own, or what its end and the log tell.
/// @param time_limit seconds
nlohmann::ordered_json error_of(const ProcessEnd& end, const std::filesystem::path& report,
                                const std::filesystem::path& log, double time_limit);

}  // namespace koebe::batch
