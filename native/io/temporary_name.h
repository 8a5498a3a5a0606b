// Names of files that live for a moment.
#pragma once

#include <filesystem>

namespace koebe::io {

/// FOLDER/.koebe-PROCESS-NUMBER.tmp, another one with every call. Short, whatever the target is called, whose name may
/// be as long as names can be. One that a killed process has left is passed over: open with O_EXCL and try the next.
std::filesystem::path temporary_name(const std::filesystem::path& folder);

}  // namespace koebe::io
