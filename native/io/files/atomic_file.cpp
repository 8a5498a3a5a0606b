#include "files/atomic_file.h"

#include "files/descriptor.h"
#include "files/file_error.h"
#include "files/file_identity.h"
#include "files/temporary_name.h"

#include <atomic>
#include <cerrno>
#include <mutex>
#include <string>
#include <system_error>
#include <utility>

namespace koebe {
namespace {

namespace fs = std::filesystem;
using io::folder_of;

std::mutex list_mutex;
AtomicFile* first_in_list = nullptr;

template <typename Reason>
[[noreturn]] void fail_writing(const fs::path& path, const Reason& reason)
{
    io::fail("cannot write " + path.string(), reason);
}

}  // namespace

fs::path io::temporary_name(const fs::path& folder)
{
    static std::atomic<unsigned> counter{0};
    return folder / (".koebe-" + std::to_string(process_number()) + "-" + std::to_string(counter++) + ".tmp");
}

AtomicFile::AtomicFile(const fs::path& target)
    : target_(io::is_pipe_or_device(target) ? target : io::followed(target))  // the link of a pipe leads to no path
{
    if (io::is_pipe_or_device(target_)) {
        descriptor_ = io::open_device(target_);
        if (descriptor_ < 0) fail();
        return;
    }
    do {
        temporary_ = io::temporary_name(folder_of(target_));
        descriptor_ = io::open_new(temporary_);
    } while (descriptor_ < 0 && errno == EEXIST);
    if (descriptor_ < 0) {
        temporary_.clear();
        fail();
    }
    std::error_code error;
    if (const fs::file_status old = fs::status(target_, error); fs::exists(old))
        fs::permissions(temporary_, old.permissions(), error);
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
    if (!temporary_.empty()) io::remove_now(temporary_);
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
        if (!file->temporary_.empty()) io::remove_now(file->temporary_);
}

void AtomicFile::write(std::string_view bytes)
{
    if (!io::write_all(descriptor_, bytes)) fail();
}

void AtomicFile::commit()
{
    if (!io::close_written(std::exchange(descriptor_, -1))) fail();
    if (temporary_.empty()) return;
    std::error_code error;
    fs::rename(temporary_, target_, error);
    if (error) fail_writing(target_, error);
    temporary_.clear();
}

void AtomicFile::close_descriptor()
{
    if (descriptor_ >= 0) io::close_written(std::exchange(descriptor_, -1));
}

void AtomicFile::fail() const { fail_writing(target_, errno); }

void require_writable(const fs::path& target)
{
    if (io::is_pipe_or_device(target)) {
        if (!io::may_write(target)) fail_writing(target, errno);
        return;
    }
    const fs::path file = io::followed(target);
    std::error_code error;
    if (file.empty()) fail_writing(target, ENOENT);
    if (fs::is_directory(file, error)) fail_writing(target, EISDIR);
    if (fs::exists(file, error) && !io::may_write(file)) fail_writing(target, errno);
    const fs::path folder = folder_of(file);
    if (!io::may_write(folder)) fail_writing(target, errno);
    if (!fs::is_directory(folder, error)) fail_writing(target, ENOTDIR);
}

}  // namespace koebe
