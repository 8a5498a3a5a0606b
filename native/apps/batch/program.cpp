#include "batch/program.h"

#include "batch/path_text.h"
#include "files/file_error.h"

#include <uv.h>

#include <filesystem>
#include <system_error>
#include <vector>

namespace koebe::batch {

namespace fs = std::filesystem;

std::string own_program()
{
    std::vector<char> buffer(32768);  // bytes; the longest path of Windows
    std::size_t size = buffer.size();
    if (const int status = uv_exepath(buffer.data(), &size); status != 0)
        fail("cannot find the command itself", status);
    return {buffer.data(), size};
}

unsigned core_count() { return uv_available_parallelism(); }

std::string blender_script(const std::string& given)
{
    std::error_code error;
    const fs::path checkout = path_of(own_program()).parent_path().parent_path();
    const fs::path script = given.empty() ? checkout / "addon" / "batch.py" : fs::absolute(path_of(given));
    if (!fs::is_regular_file(script, error))
        throw FileError("the add-on's batch.py is not at " + utf8(script) + ": name it with --blender-script");
    return utf8(script);
}

}  // namespace koebe::batch
