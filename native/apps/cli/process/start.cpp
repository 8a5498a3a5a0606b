// Runs before the libraries start.
#include "exit_code.h"

#include <new>
#include <string_view>

#include <unistd.h>

namespace koebe::cli {
namespace {

[[noreturn]] void end_start()
{
    constexpr std::string_view line = "OutOfMemory: there is too little memory to start\n";
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), line.size());
    ::_exit(cannot_be_mapped);
}

/// An exception while objects are made before main() would end the process in another way.
void watch_memory(int, char**, char**) { std::set_new_handler(end_start); }

[[gnu::section(".preinit_array"), gnu::used]] void (*const before_libraries)(int, char**, char**) = watch_memory;

}  // namespace
}  // namespace koebe::cli
