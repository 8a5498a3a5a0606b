#include "batch/claim.h"

#include "batch/content_hash.h"
#include "batch/path_text.h"
#include "files/file_error.h"

#include <nlohmann/json.hpp>
#include <uv.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <set>
#include <system_error>
#include <utility>

namespace koebe::batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr std::size_t key_digits = 32;
constexpr double unwritten_seconds = 10.0;  // a claim is written right after its creation
constexpr unsigned look_ms = 50;
constexpr const char* work_ending = ".work";

class Request {
public:
    ~Request() { uv_fs_req_cleanup(&request_); }
    uv_fs_t* get() { return &request_; }

private:
    uv_fs_t request_{};
};

std::string host_name()
{
    std::array<char, UV_MAXHOSTNAMESIZE> buffer{};
    std::size_t size = buffer.size();
    const std::string name = uv_os_gethostname(buffer.data(), &size) == 0 ? buffer.data() : "";
    return name.starts_with("localhost") ? "" : name;  // the name of many machines
}

/// @return 0, or an error of libuv
int create(const fs::path& path, const std::string& text)
{
    Request open, write, close;
    const int file = uv_fs_open(nullptr, open.get(), utf8(path).c_str(), UV_FS_O_WRONLY | UV_FS_O_CREAT | UV_FS_O_EXCL,
                                0666, nullptr);
    if (file < 0) return file;
    const uv_buf_t bytes = uv_buf_init(const_cast<char*>(text.data()), static_cast<unsigned>(text.size()));
    const int written = uv_fs_write(nullptr, write.get(), file, &bytes, 1, 0, nullptr);
    uv_fs_close(nullptr, close.get(), file, nullptr);
    return written < 0 ? written : 0;
}

/// The time of a file's last change, asked through an open file, as network file systems answer from a cache otherwise.
std::string time_of_change(const fs::path& path)
{
    Request open, status, close;
    const int file = uv_fs_open(nullptr, open.get(), utf8(path).c_str(), UV_FS_O_RDONLY, 0, nullptr);
    if (file < 0) return {};
    std::string text;
    if (uv_fs_fstat(nullptr, status.get(), file, nullptr) == 0) {
        const uv_timespec_t& time = status.get()->statbuf.st_mtim;
        text = std::to_string(time.tv_sec) + "." + std::to_string(time.tv_nsec);
    }
    uv_fs_close(nullptr, close.get(), file, nullptr);
    return text;
}

fs::path claim_path(const fs::path& folder, const std::string& key, long generation)
{
    return folder / (key + "." + std::to_string(generation));
}

void remove_claim(const fs::path& file) noexcept
{
    std::error_code error;
    fs::remove_all(fs::path(file) += work_ending, error);
    fs::remove(file, error);
}

}  // namespace

Claims::Claims(fs::path folder, double stale) : folder_(std::move(folder)), stale_(stale), host_(host_name()) {}

long Claims::highest(const std::string& key) const
{
    long found = 0;
    std::error_code error;
    for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = utf8(entry->path().filename());
        if (!name.starts_with(key + ".")) continue;
        long generation = 0;
        const char* const last = name.data() + name.size();
        const auto [end_of_number, problem] = std::from_chars(name.data() + key.size() + 1, last, generation);
        if (problem == std::errc{} && end_of_number == last) found = std::max(found, generation);
    }
    return found;
}

bool Claims::is_dead(const std::string& key, long generation)
{
    const fs::path path = claim_path(folder_, key, generation);
    std::ifstream file(path);
    const Json owner = Json::parse(file, nullptr, false);
    if (owner.is_object() && !host_.empty() && owner.value("host", "") == host_) {
        const int process = owner.value("process", 0);
        // This process does not check its own claims: its number on another claim is that of an earlier process.
        if (process == uv_os_getpid() || uv_kill(process, 0) == UV_ESRCH) return true;
    }
    const auto now = std::chrono::steady_clock::now();
    const std::string state = time_of_change(path);
    Watch& watch = watched_.try_emplace(key, Watch{generation, state, now}).first->second;
    if (watch.generation != generation || watch.state != state) watch = {generation, state, now};
    return std::chrono::duration<double>(now - watch.since).count() > (owner.is_object() ? stale_ : unwritten_seconds);
}

std::optional<Claims::Claim> Claims::take(const std::string& name)
{
    return take_key(sha256_of_text(name).substr(0, key_digits), name);
}

std::optional<Claims::Claim> Claims::take_key(const std::string& key, const std::string& name)
{
    Claim claim;
    claim.key_ = key;
    const long holder = highest(claim.key_);
    if (holder > 0 && !is_dead(claim.key_, holder)) return {};
    claim.generation_ = holder + 1;
    claim.word_ = claim.key_ + "." + std::to_string(claim.generation_);
    claim.file_ = claim_path(folder_, claim.key_, claim.generation_);
    claim.work_ = fs::path(claim.file_) += work_ending;
    const std::string owner = Json{{"host", host_}, {"process", uv_os_getpid()}, {"file", name}}.dump(
        -1, ' ', false, Json::error_handler_t::replace);
    int status = UV_ENOENT;
    std::error_code error;
    for (int attempt = 0; status == UV_ENOENT && attempt < 10; ++attempt) {  // another run may remove the folder
        fs::create_directories(folder_, error);
        status = create(claim.file_, owner);
    }
    if (status == UV_EEXIST) return {};
    if (status == 0 && !fs::create_directory(claim.work_, error) && error) status = UV_EACCES;
    if (status != 0) {
        remove_claim(claim.file_);
        fail("cannot write " + utf8(claim.file_), status);
    }
    if (holder > 0) remove_claim(claim_path(folder_, claim.key_, holder));
    watched_.erase(claim.key_);
    return claim;
}

Claims::Claim Claims::wait(const std::string& name)
{
    for (;; uv_sleep(look_ms))
        if (auto claim = take(name)) return std::move(*claim);
}

void Claims::release_dead()
{
    std::set<std::string> keys;
    std::error_code error;
    for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error))
        if (entry->path().extension() != work_ending) keys.insert(utf8(entry->path().stem()));
    for (const std::string& key : keys)
        if (auto claim = take_key(key, "")) claim->release();
}

void Claims::clean_up() noexcept
{
    try {
        release_dead();
    } catch (const std::exception&) {  // the next run does it
    }
    std::error_code error;
    for (fs::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
        std::error_code ignored;
        const fs::path path = entry->path();  // written by a process after the run that started it had ended
        if (path.extension() == work_ending && !fs::exists(fs::path(path).replace_extension(), ignored))
            fs::remove_all(path, ignored);
    }
    fs::remove(folder_, error);
}

void Claims::Claim::beat() const noexcept
{
    std::error_code error;
    fs::last_write_time(file_, fs::file_time_type::clock::now(), error);
}

bool Claims::Claim::is_held() const
{
    std::error_code error;
    return !is_released_ && fs::exists(file_, error) &&
           !fs::exists(claim_path(file_.parent_path(), key_, generation_ + 1), error);
}

void Claims::Claim::release() noexcept
{
    if (!std::exchange(is_released_, true)) remove_claim(file_);
}

}  // namespace koebe::batch
