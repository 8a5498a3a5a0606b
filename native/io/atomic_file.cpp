#include "io/atomic_file.h"

#include "io/file_error.h"
#include "io/file_identity.h"
#include "io/temporary_name.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <string>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace koebe {
namespace {

namespace fs = std::filesystem;
using io::folder_of;

std::mutex list_mutex;
AtomicFile* first_in_list = nullptr;

[[noreturn]] void fail_writing(const fs::path& path, int error_number)
{
    throw FileError("cannot write " + path.string() + " (" + std::strerror(error_number) + ")");
}

/// @returns the target's permissions, if it is there
std::pair<bool, mode_t> permissions_of(const fs::path& path)
{
    struct stat status;
    if (::stat(path.c_str(), &status) != 0) return {false, 0};
    return {true, status.st_mode & 07777};
}

}  // namespace

fs::path io::temporary_name(const fs::path& folder)
{
    static std::atomic<unsigned> counter{0};
    return folder / (".koebe-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".tmp");
}

AtomicFile::AtomicFile(const fs::path& target)
    : target_(io::is_pipe_or_device(target) ? target : io::followed(target))  // a pipe's link leads to no path
{
    if (io::is_pipe_or_device(target_)) {
        descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor_ < 0) fail();
        return;
    }
    do {
        temporary_ = io::temporary_name(folder_of(target_));
        descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && errno == EEXIST);
    if (descriptor_ < 0) {
        temporary_.clear();
        fail();
    }
    if (const auto [exists, mode] = permissions_of(target_); exists) ::fchmod(descriptor_, mode);
    enlist();
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      descriptor_(std::exchange(other.descriptor_, -1))
{
    enlist();
}

AtomicFile::~AtomicFile()
{
    close_descriptor();
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
    const std::scoped_lock lock(list_mutex);
    AtomicFile** link = &first_in_list;
    while (*link != nullptr && *link != this) link = &(*link)->next_;
    if (*link == this) *link = next_;
}

void AtomicFile::enlist()
{
    const std::scoped_lock lock(list_mutex);
    next_ = std::exchange(first_in_list, this);
}

void AtomicFile::remove_temporary_files() noexcept
{
    for (const AtomicFile* file = first_in_list; file != nullptr; file = file->next_)
        if (!file->temporary_.empty()) ::unlink(file->temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail();
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

void AtomicFile::commit()
{
    const int result = ::close(std::exchange(descriptor_, -1));
    if (result != 0 && errno != EINTR) fail();
    if (temporary_.empty()) return;
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail();
    temporary_.clear();
}

void AtomicFile::close_descriptor()
{
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

void AtomicFile::fail() const { fail_writing(target_, errno); }

void require_writable(const fs::path& target)
{
    if (io::is_pipe_or_device(target)) {
        if (::access(target.c_str(), W_OK) != 0) fail_writing(target, errno);
        return;
    }
    const fs::path file = io::followed(target);
    std::error_code error;
    if (file.empty()) fail_writing(target, ENOENT);
    if (fs::is_directory(file, error)) fail_writing(target, EISDIR);
    if (fs::exists(file, error) && ::access(file.c_str(), W_OK) != 0) fail_writing(target, errno);
    const fs::path folder = folder_of(file);
    if (::access(folder.c_str(), W_OK | X_OK) != 0) fail_writing(target, errno);
    if (!fs::is_directory(folder, error)) fail_writing(target, ENOTDIR);
}

}  // namespace koebe
