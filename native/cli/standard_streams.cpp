#include "cli/standard_streams.h"

#include "io/file_error.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

namespace koebe::cli {
namespace {

[[noreturn]] void fail(int error_number, const std::string& done)
{
    throw FileError(std::string("cannot write standard output (") + std::strerror(error_number) + ")" + done);
}

}  // namespace

void keep_standard_streams()
{
    // Each is open in the direction that nobody asks for; open() takes the lowest number that is free.
    for (const auto& [stream, direction] :
         {std::pair{STDIN_FILENO, O_WRONLY}, std::pair{STDOUT_FILENO, O_RDONLY}, std::pair{STDERR_FILENO, O_RDONLY}})
        if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", direction);
}

void require_standard_output()
{
    const int flags = ::fcntl(STDOUT_FILENO, F_GETFL);
    if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY) fail(EBADF, "");
}

void print(std::string_view text, const std::string& done)
{
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) fail(errno, done);
}

}  // namespace koebe::cli
