// Writes a file as a whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace koebe {

/// Writes to a temporary file in the target's folder, which commit renames to the target. Without commit the temporary
/// file is removed and the target does not change. A killed process may leave the temporary file (io::temporary_name),
/// which disturbs no later run. A symbolic link stays, and its target is replaced. Permissions of a replaced file are
/// kept. A target that is not a regular file (a pipe, /dev/null) is written to directly.
class AtomicFile {
public:
    /// @throws FileError the temporary file cannot be made
    explicit AtomicFile(const std::filesystem::path& target);
    ~AtomicFile();
    AtomicFile(AtomicFile&& other) noexcept;
    AtomicFile& operator=(AtomicFile&&) = delete;

    /// @throws FileError for example, the disk is full
    void write(std::string_view bytes);
    /// @throws FileError the target cannot be replaced
    void commit();

    /// Removes all files that are not committed, for a process that ends without destructors. Allocates no memory; no
    /// other thread may use such files.
    static void remove_temporary_files() noexcept;

private:
    void close_descriptor();
    void enlist();
    [[noreturn]] void fail() const;

    std::filesystem::path target_, temporary_;
    int descriptor_ = -1;
    AtomicFile* next_ = nullptr;  ///< in the list of all such files
};

/// Checks before a long computation that an AtomicFile can be made.
/// @throws FileError the folder is missing or not writable; the target is a folder or a file that is not writable
void require_writable(const std::filesystem::path& target);

}  // namespace koebe
