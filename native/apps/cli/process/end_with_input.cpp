#include "cli/process/end_with_input.h"

#include "exit_code.h"

#include <uv.h>

#include <cstdlib>
#include <thread>

namespace koebe::cli {
namespace {

bool has_more_input()
{
    constexpr uv_file standard_input = 0;
    char byte = 0;
    const uv_buf_t buffer = uv_buf_init(&byte, 1);
    uv_fs_t request;
    const int count = uv_fs_read(nullptr, &request, standard_input, &buffer, 1, -1, nullptr);
    uv_fs_req_cleanup(&request);
    return count > 0;
}

}  // namespace

void end_with_input()
{
    std::thread([] {
        while (has_more_input()) {
        }
        std::_Exit(interrupted);  // the next run removes the folder with unfinished files
    }).detach();
}

}  // namespace koebe::cli
