// The table of a batch: one row a file, as JSON and as CSV.
#pragma once

#include "batch/claim.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace koebe::batch {

inline constexpr const char* summary_json = "summary.json";
inline constexpr const char* summary_csv = "summary.csv";
/// Beside the results: claims, and what is not whole yet.
inline constexpr const char* work_folder = ".koebe-batch";

/// The row of a file's report: name, exit_code, error, error_text, seconds, faces, flipped, below_resolution,
/// lost_area, angle_error_deg (the mean), warnings (their number), output, input_sha256, options, version. null for what
/// is not known. Of a .blend the sums over its islands; the angle error is their mean by faces, lost_area the largest.
nlohmann::ordered_json summary_row(const nlohmann::ordered_json& report);

/// Writes summary.json and summary.csv with a row for every report in the folder, each file whole or absent. Of runs at
/// once one after the other writes, and each looks for new reports when it has: so the last table has all.
/// @throws FileError
void write_summary(const std::filesystem::path& folder, Claims& claims);
/// The same outside a run.
/// @param stale as Claims takes it
void write_summary(const std::filesystem::path& folder, double stale);

}  // namespace koebe::batch
