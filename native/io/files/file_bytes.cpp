#include "files/file_bytes.h"

#include "files/descriptor.h"
#include "files/file_error.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>

namespace koebe::io {

namespace fs = std::filesystem;

std::string read_bytes(const fs::path& path)
{
    const auto fail_reading = [&path] { fail("cannot read " + path.string(), errno); };
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(io::open_to_read(path), std::fclose);
    if (!file) fail_reading();
    if (fs::is_character_file(path) || fs::is_block_file(path))  // these may have no end
        throw FileError("cannot read " + path.string() + " (it is a device)");
    std::string bytes;
    std::error_code no_size;  // a pipe has no size
    const auto size = fs::file_size(path, no_size);
    std::size_t wanted = no_size ? 0 : static_cast<std::size_t>(size) + 1;
    for (std::size_t filled = 0;;) {
        wanted = std::max(wanted, filled + (std::size_t{1} << 16));
        bytes.resize(wanted);
        const std::size_t got = std::fread(bytes.data() + filled, 1, wanted - filled, file.get());
        filled += got;
        if (filled < wanted) {
            if (std::ferror(file.get())) fail_reading();
            bytes.resize(filled);
            return bytes;
        }
    }
}

}  // namespace koebe::io
