#include "files/descriptor.h"

#include <cerrno>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace koebe::io {

namespace fs = std::filesystem;

namespace {

bool is_same_file(const struct stat& a, const struct stat& b)
{
    if (a.st_dev != b.st_dev || a.st_ino != b.st_ino) return false;
    struct stat null;
    return !(S_ISCHR(a.st_mode) && ::stat("/dev/null", &null) == 0 && a.st_rdev == null.st_rdev);
}

}  // namespace

int open_new(const fs::path& path) { return ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666); }

int open_device(const fs::path& path) { return ::open(path.c_str(), O_WRONLY | O_CLOEXEC); }

std::FILE* open_to_read(const fs::path& path) { return std::fopen(path.c_str(), "rb"); }

bool write_all(int descriptor, std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

bool close_written(int descriptor) { return ::close(descriptor) == 0 || errno == EINTR; }

void remove_now(const fs::path& path) noexcept { ::unlink(path.c_str()); }

bool may_write(const fs::path& path)
{
    std::error_code error;
    return ::access(path.c_str(), fs::is_directory(path, error) ? W_OK | X_OK : W_OK) == 0;
}

bool is_same(const fs::path& a, const fs::path& b)
{
    struct stat there_a, there_b;
    return ::stat(a.c_str(), &there_a) == 0 && ::stat(b.c_str(), &there_b) == 0 && is_same_file(there_a, there_b);
}

bool is_open_as(int descriptor, const fs::path& path)
{
    struct stat open_file, there;
    return ::fstat(descriptor, &open_file) == 0 && ::stat(path.c_str(), &there) == 0 && is_same_file(open_file, there);
}

int process_number() { return static_cast<int>(::getpid()); }

}  // namespace koebe::io
