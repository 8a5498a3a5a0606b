// A file that is whole or absent.
#pragma once

#include <filesystem>
#include <string_view>

namespace koebe {

/// Writes to a temporary file in the target's folder, which commit renames to the target. Without commit, nothing
/// of it stays and a file of the target's name stays as it was; a process that is killed may leave the temporary file
/// (io::temporary_name), which disturbs no later run. A symbolic link is followed, so that it stays and its target is
/// replaced; the permissions of the file replaced are kept. A target that is no regular file (a pipe, /dev/null) is
/// written to directly.
class AtomicFile {
public:
    /// @throws FileError the temporary file cannot be made
    explicit AtomicFile(const std::filesystem::path& target);
    ~AtomicFile();
    AtomicFile(AtomicFile&& other) noexcept;
    AtomicFile& operator=(AtomicFile&&) = delete;

    /// @throws FileError as on a full disk
    void write(std::string_view bytes);
    /// @throws FileError the target cannot be replaced
    void commit();

    /// Removes all that was not committed, for an end of the process that runs no destructors. It asks for no memory;
    /// nobody may be at work on such files.
    static void remove_temporary_files() noexcept;

private:
    void close_descriptor();
    void enlist();
    [[noreturn]] void fail() const;

    std::filesystem::path target_, temporary_;
    int descriptor_ = -1;
    AtomicFile* next_ = nullptr;  ///< in the list of all there are
};

/// What AtomicFile needs, asked before a long computation.
/// @throws FileError the folder is missing or not writable; the target is a folder or a file that is not writable
void require_writable(const std::filesystem::path& target);

}  // namespace koebe
