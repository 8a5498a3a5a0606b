#include "io/file_identity.h"

#include "io/extension.h"
#include "io/file_error.h"
#include "io/temporary_name.h"

#include <cerrno>
#include <cstring>
#include <optional>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace koebe::io {
namespace {

namespace fs = std::filesystem;

constexpr int most_links = 40;  // as the kernel has it

std::optional<struct stat> status_of(const fs::path& path)
{
    struct stat status;
    if (::stat(path.c_str(), &status) != 0) return {};
    return status;
}

bool same(const struct stat& a, const struct stat& b)
{
    if (a.st_dev != b.st_dev || a.st_ino != b.st_ino) return false;
    const auto null = status_of("/dev/null");
    return !(S_ISCHR(a.st_mode) && null && a.st_rdev == null->st_rdev);
}

/// Asked of the file system itself, by a file that lives for a moment.
bool ignores_case(const fs::path& folder)
{
    const fs::path small = temporary_name(folder);
    const int descriptor = ::open(small.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (descriptor < 0) return false;  // nothing can be made there at all
    ::close(descriptor);
    std::string large = small.filename().string();
    for (char& c : large)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    const bool found = status_of(folder / large).has_value();
    ::unlink(small.c_str());
    return found;
}

bool same_name_to_be(const fs::path& a, const fs::path& b)
{
    const auto folder_a = status_of(folder_of(a)), folder_b = status_of(folder_of(b));
    if (!folder_a || !folder_b) return a.lexically_normal() == b.lexically_normal();
    if (!same(*folder_a, *folder_b)) return false;
    if (a.filename() == b.filename()) return true;
    return lower(a.filename().string()) == lower(b.filename().string()) && ignores_case(folder_of(a));
}

}  // namespace

fs::path followed(const fs::path& path)
{
    std::error_code error;
    fs::path target = path;
    for (int links = 0; fs::is_symlink(target, error); ++links) {
        if (links == most_links) throw FileError("cannot write " + path.string() + " (" + std::strerror(ELOOP) + ")");
        target = target.parent_path() / fs::read_symlink(target, error);
    }
    return target;
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

bool is_pipe_or_device(const fs::path& path)
{
    const auto status = status_of(path);
    return status && !S_ISREG(status->st_mode) && !S_ISDIR(status->st_mode);
}

bool same_file(const fs::path& a, const fs::path& b)
{
    const auto status_a = status_of(a), status_b = status_of(b);
    if (status_a && status_b) return same(*status_a, *status_b);
    if (status_a || status_b) return false;
    return same_name_to_be(followed(a), followed(b));
}

bool same_file(const fs::path& a, int descriptor)
{
    struct stat open_file;
    const auto status = status_of(a);
    return status && ::fstat(descriptor, &open_file) == 0 && same(*status, open_file);
}

}  // namespace koebe::io
