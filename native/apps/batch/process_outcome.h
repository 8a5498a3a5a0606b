// How a mapping process ended, and what it reports about that.
#pragma once

#include "batch/child_process.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace koebe::batch {

/// Whether the process made a map, converged or not.
bool is_mapped(const ProcessEnd& end);

/// Whether the process was ended from outside, and not by the time limit.
bool is_killed(const ProcessEnd& end);

/// The process's own report, or an empty object.
nlohmann::ordered_json own_report(const std::filesystem::path& report);

/// The error of a process that made no map: its own error, or what its exit status and the log tell.
/// @param time_limit seconds
nlohmann::ordered_json error_of(const ProcessEnd& end, const std::filesystem::path& report,
                                const std::filesystem::path& log, double time_limit);

}  // namespace koebe::batch
