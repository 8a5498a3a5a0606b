// Names of temporary files.
#pragma once

#include <filesystem>

namespace koebe::io {

/// FOLDER/.koebe-PROCESS-NUMBER.tmp, different in every call. It is short, as the target's name may have the greatest
/// length. A killed process may have left a file of that name: open with O_EXCL and try the next name.
std::filesystem::path temporary_name(const std::filesystem::path& folder);

}  // namespace koebe::io
