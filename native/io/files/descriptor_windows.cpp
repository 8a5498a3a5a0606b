#include "files/descriptor.h"

#include <algorithm>
#include <string>

#include <fcntl.h>
#include <io.h>
#include <process.h>
#include <sys/stat.h>
#include <windows.h>

namespace koebe::io {

namespace fs = std::filesystem;

int open_new(const fs::path& path)
{
    return ::_wopen(path.c_str(), _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY | _O_NOINHERIT, _S_IREAD | _S_IWRITE);
}

int open_device(const fs::path& path) { return ::_wopen(path.c_str(), _O_WRONLY | _O_BINARY | _O_NOINHERIT); }

std::FILE* open_to_read(const fs::path& path) { return ::_wfopen(path.c_str(), L"rbN"); }

bool write_all(int descriptor, std::string_view bytes)
{
    constexpr std::size_t most = std::size_t{1} << 30;  // the count of a call is an int
    while (!bytes.empty()) {
        const int written = ::_write(descriptor, bytes.data(), static_cast<unsigned>(std::min(bytes.size(), most)));
        if (written < 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

bool close_written(int descriptor) { return ::_close(descriptor) == 0; }

void remove_now(const fs::path& path) noexcept { ::_wunlink(path.c_str()); }

bool may_write(const fs::path& path)
{
    return ::_waccess(path.c_str(), 2) == 0;  // 2: to write
}

bool is_same(const fs::path& a, const fs::path& b)
{
    std::error_code error;
    return fs::equivalent(a, b, error);
}

bool is_open_as(int descriptor, const fs::path& path)
{
    const auto file = reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor));
    wchar_t name[32768];
    const DWORD length = ::GetFinalPathNameByHandleW(file, name, std::size(name), 0);
    return length > 0 && length < std::size(name) && is_same(fs::path(name, name + length), path);
}

int process_number() { return ::_getpid(); }

}  // namespace koebe::io
