// koebe uniformize --cut: any mesh, each corner with its own texture coordinates.
#pragma once

#include "cli/commands/map_command.h"

namespace koebe::cli {

/// As run_map, with uniformize_with_cuts.
/// @return an ExitCode
int run_cut_map(const MapRequest& request);

}  // namespace koebe::cli
