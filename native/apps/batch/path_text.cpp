#include "batch/path_text.h"

#include "files/file_error.h"

#include <uv.h>

namespace koebe::batch {
namespace {

std::string bytes(const std::u8string& text) { return {text.begin(), text.end()}; }

}  // namespace

std::string utf8(const std::filesystem::path& path) { return bytes(path.u8string()); }

std::string generic_utf8(const std::filesystem::path& path) { return bytes(path.generic_u8string()); }

std::filesystem::path path_of(const std::string& text) { return std::u8string(text.begin(), text.end()); }

void fail(const std::string& what, int libuv_status)
{
    const std::string message = what + " (" + uv_strerror(libuv_status) + ")";
    if (libuv_status == UV_ENOMEM) throw OutOfMemory(message);
    throw FileError(message);
}

}  // namespace koebe::batch
