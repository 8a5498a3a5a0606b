#include "batch/whole_file.h"

#include "batch/path_text.h"
#include "files/atomic_file.h"
#include "files/file_error.h"

#include <system_error>

namespace koebe::batch {

void write_whole(const std::filesystem::path& work, const std::filesystem::path& target, std::string_view text)
{
    const std::filesystem::path written = work / target.filename();
    AtomicFile file(written);
    file.write(text);
    file.commit();
    move_whole(written, target);
}

void move_whole(const std::filesystem::path& source, const std::filesystem::path& target)
{
    std::error_code error;
    std::filesystem::rename(source, target, error);
    if (error) io::fail("cannot write " + utf8(target), error);
}

}  // namespace koebe::batch
