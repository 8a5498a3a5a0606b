#include "files/file_identity.h"

#include "files/descriptor.h"
#include "files/extension.h"
#include "files/file_error.h"
#include "files/temporary_name.h"

#include <cerrno>
#include <cstring>
#include <system_error>

namespace koebe::io {
namespace {

namespace fs = std::filesystem;

constexpr int most_links = 40;  // as in the kernel

bool is_there(const fs::path& path)
{
    std::error_code error;
    return fs::exists(path, error);
}

/// Asks the file system itself, with a temporary file.
bool ignores_case(const fs::path& folder)
{
    const fs::path small = temporary_name(folder);
    const int descriptor = open_new(small);
    if (descriptor < 0) return false;  // no file can be made there at all
    close_written(descriptor);
    std::string large = small.filename().string();
    for (char& c : large)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    const bool found = is_there(folder / large);
    remove_now(small);
    return found;
}

bool same_name_to_be(const fs::path& a, const fs::path& b)
{
    const fs::path folder_a = folder_of(a), folder_b = folder_of(b);
    if (!is_there(folder_a) || !is_there(folder_b)) return a.lexically_normal() == b.lexically_normal();
    if (!is_same(folder_a, folder_b)) return false;
    if (a.filename() == b.filename()) return true;
    return lower(a.filename().string()) == lower(b.filename().string()) && ignores_case(folder_a);
}

}  // namespace

fs::path followed(const fs::path& path)
{
    std::error_code error;
    fs::path target = path;
    for (int links = 0; fs::is_symlink(target, error); ++links) {
        if (links == most_links) fail("cannot write " + path.string(), ELOOP);
        target = target.parent_path() / fs::read_symlink(target, error);
    }
    return target;
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

bool is_pipe_or_device(const fs::path& path)
{
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

bool same_file(const fs::path& a, const fs::path& b)
{
    const bool has_a = is_there(a), has_b = is_there(b);
    if (has_a && has_b) return is_same(a, b);
    if (has_a || has_b) return false;
    return same_name_to_be(followed(a), followed(b));
}

}  // namespace koebe::io
