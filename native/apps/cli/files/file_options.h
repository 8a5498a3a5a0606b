// Options of how files are read and written, of several commands: rows of options/options.json.
#pragma once

#include "core/option_list.h"

#include <optional>

namespace koebe::cli {

struct FileOptions {
    std::optional<double> weld = {};  ///< distance of vertices that are joined in the map (io/welding.h)
    int uv_channel = 0;               ///< the set of UVs that is written, where a file has several

    KOEBE_OPTIONS(FileOptions, weld, uv_channel)
};

}  // namespace koebe::cli
