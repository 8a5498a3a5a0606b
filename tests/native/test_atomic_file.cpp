// Laws of atomic files: before commit nothing has changed, and after it everything.
#include "files/atomic_file.h"

#include "files/file_error.h"
#include "files/temporary_name.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace koebe {
namespace {

namespace fs = std::filesystem;
using test::bytes_of;
using test::TemporaryFolder;

TEST(AtomicFile, ReplacesOnCommitAndNotBefore)
{
    const TemporaryFolder folder;
    const fs::path target = folder.write("out", "old");
    AtomicFile file(target);
    file.write("new");
    EXPECT_EQ(bytes_of(target), "old");
    file.commit();
    EXPECT_EQ(bytes_of(target), "new");
    EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, LeavesNothingBehindWithoutCommit)
{
    const TemporaryFolder folder;
    {
        AtomicFile file(folder.path() / "out");
        file.write("half");
        EXPECT_EQ(folder.file_count(), 1u);
        AtomicFile moved(std::move(file));
        moved.write(" of it");
    }
    EXPECT_EQ(folder.file_count(), 0u);
}

TEST(AtomicFile, TwoOfOneTargetDoNotMix)
{
    const TemporaryFolder folder;
    AtomicFile a(folder.path() / "out"), b(folder.path() / "out");
    a.write("first");
    b.write("second");
    b.commit();
    a.commit();
    EXPECT_EQ(bytes_of(folder.path() / "out"), "first");
    EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, FollowsLinksAndKeepsPermissions)
{
    const TemporaryFolder folder;
    const fs::path target = folder.write("target", "old");
    fs::permissions(target, fs::perms::owner_read | fs::perms::owner_write | fs::perms::others_read);
    fs::create_symlink("target", folder.path() / "link");
    fs::create_symlink("link", folder.path() / "link_to_link");
    AtomicFile file(folder.path() / "link_to_link");
    file.write("new");
    file.commit();
    EXPECT_TRUE(fs::is_symlink(folder.path() / "link_to_link"));
    EXPECT_EQ(bytes_of(target), "new");
    EXPECT_EQ(fs::status(target).permissions(),
              fs::perms::owner_read | fs::perms::owner_write | fs::perms::others_read);
    EXPECT_EQ(folder.file_count(), 3u);
}

TEST(AtomicFile, NewFilesHaveThePermissionsOfAnyOther)
{
    const TemporaryFolder folder;
    const fs::path other = folder.write("other", "");
    AtomicFile file(folder.path() / "out");
    file.commit();
    EXPECT_EQ(fs::status(folder.path() / "out").permissions(), fs::status(other).permissions());
}

TEST(AtomicFile, NamesMayBeAsLongAsTheSystemAllows)
{
    const TemporaryFolder folder;
    AtomicFile file(folder.path() / std::string(255, 'n'));
    file.commit();
    EXPECT_TRUE(fs::exists(folder.path() / std::string(255, 'n')));
}

TEST(AtomicFile, WhatAKilledProcessLeftIsPassedOver)
{
    const TemporaryFolder folder;
    std::vector<fs::path> left;
    for (int i = 0; i < 3; ++i) {  // the names that come next, as a process of the same number would have had
        const std::string name = io::temporary_name(folder.path()).filename().string();
        const std::size_t number = name.rfind('-') + 1;
        left.push_back(
            folder.write(name.substr(0, number) + std::to_string(std::stoi(name.substr(number)) + 3) + ".tmp", "left"));
    }
    AtomicFile file(folder.path() / "out");
    file.write("new");
    file.commit();
    EXPECT_EQ(bytes_of(folder.path() / "out"), "new");
    for (const fs::path& path : left) EXPECT_EQ(bytes_of(path), "left");
    EXPECT_EQ(folder.file_count(), 4u);
}

TEST(AtomicFile, AFileThatIsNotWritableIsNotReplaced)
{
    const TemporaryFolder folder;
    const fs::path file = folder.write("file", "old");
    fs::permissions(file, fs::perms::owner_read);
    if (::access(file.c_str(), W_OK) == 0) GTEST_SKIP() << "root may write everything";
    EXPECT_THROW(require_writable(file), FileError);
}

TEST(AtomicFile, LinksThatLeadNowhereGetTheirTarget)
{
    const TemporaryFolder folder;
    fs::create_symlink("target", folder.path() / "link");
    EXPECT_NO_THROW(require_writable(folder.path() / "link"));
    AtomicFile file(folder.path() / "link");
    file.write("new");
    file.commit();
    EXPECT_TRUE(fs::is_symlink(folder.path() / "link"));
    EXPECT_EQ(bytes_of(folder.path() / "target"), "new");
}

// With a pipe of its own: were the law broken, root would lose /dev/null here.
TEST(AtomicFile, PipesAreWrittenToAndNotReplaced)
{
    const TemporaryFolder folder;
    const fs::path pipe = folder.path() / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const int reader = ::open(pipe.c_str(), O_RDWR);
    AtomicFile file(pipe);
    file.write("through");
    file.commit();
    char bytes[16] = {};
    ASSERT_TRUE(fs::is_fifo(pipe));
    EXPECT_EQ(::read(reader, bytes, sizeof bytes), 7);
    EXPECT_STREQ(bytes, "through");
    EXPECT_EQ(folder.file_count(), 1u);
    ::close(reader);
}

TEST(AtomicFile, WhatCannotBeWrittenIsSaidBefore)
{
    const TemporaryFolder folder;
    const fs::path file = folder.write("file", "");
    EXPECT_NO_THROW(require_writable(file));
    EXPECT_NO_THROW(require_writable(folder.path() / "new"));
    EXPECT_NO_THROW(require_writable("relative"));
    EXPECT_NO_THROW(require_writable("/dev/null"));
    for (const fs::path& bad : {folder.path(), folder.path() / "missing" / "out", file / "out", fs::path()}) {
        SCOPED_TRACE(bad);
        EXPECT_THROW(require_writable(bad), FileError);
    }
    EXPECT_EQ(folder.file_count(), 1u);
    for (const fs::path& bad : {folder.path() / "missing" / "out", file / "out"})
        EXPECT_THROW(AtomicFile{bad}, FileError);
}

}  // namespace
}  // namespace koebe
