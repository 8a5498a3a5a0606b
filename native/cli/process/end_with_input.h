// A process that is not to outlive the one that started it.
#pragma once

namespace koebe::cli {

/// Hidden: what `koebe batch` gives to the processes that it starts.
inline constexpr const char* end_with_input_flag = "--end-with-input";

/// From now on the process ends when its standard input does, which is a pipe from the one that started it.
void end_with_input();

}  // namespace koebe::cli
