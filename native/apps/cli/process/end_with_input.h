// Ends a process together with the one that started it.
#pragma once

namespace koebe::cli {

/// Hidden flag that `koebe batch` gives to the processes it starts.
inline constexpr const char* end_with_input_flag = "--end-with-input";

/// From now on the process ends when its standard input closes, a pipe from the process that started it.
void end_with_input();

}  // namespace koebe::cli
