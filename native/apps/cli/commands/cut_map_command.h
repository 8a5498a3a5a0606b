// koebe uniformize --cut: maps any mesh, with texture coordinates per corner.
#pragma once

#include "cli/commands/map_command.h"

namespace koebe::cli {

/// As run_map, with uniformize_with_cuts.
/// @return an ExitCode
int run_cut_map(const MapRequest& request);

}  // namespace koebe::cli
