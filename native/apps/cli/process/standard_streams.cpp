#include "cli/process/standard_streams.h"

#include "files/file_error.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#if defined(_WIN32)
#include <io.h>
#include <windows.h>
#else
#include <unistd.h>
#endif

namespace koebe::cli {
namespace {

[[noreturn]] void fail(int error_number, const std::string& done)
{
    throw FileError(std::string("cannot write standard output (") + std::strerror(error_number) + ")" + done);
}

}  // namespace

#if defined(_WIN32)

// On Windows a closed stream has no handle, and no file takes its place.
void keep_standard_streams() {}

void require_standard_output()
{
    if (::_get_osfhandle(standard_output) < 0) fail(EBADF, "");
}

bool is_error_shown()
{
    const HANDLE console = ::GetStdHandle(STD_ERROR_HANDLE);
    DWORD mode = 0;
    return ::GetConsoleMode(console, &mode) && ::SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
}

#else

void keep_standard_streams()
{
    // Open each stream in the direction that is not used; open() takes the lowest free number.
    for (const auto& [stream, direction] :
         {std::pair{STDIN_FILENO, O_WRONLY}, std::pair{STDOUT_FILENO, O_RDONLY}, std::pair{STDERR_FILENO, O_RDONLY}})
        if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", direction);
}

void require_standard_output()
{
    const int flags = ::fcntl(standard_output, F_GETFL);
    if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY) fail(EBADF, "");
}

bool is_error_shown() { return ::isatty(STDERR_FILENO) == 1; }

#endif

void print(std::string_view text, const std::string& done)
{
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) fail(errno, done);
}

}  // namespace koebe::cli
