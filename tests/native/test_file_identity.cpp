// Laws of identity: what is one file on the disk is the same, whatever it is called, and nothing else is.
#include "files/descriptor.h"
#include "files/file_identity.h"

#include "files/atomic_file.h"
#include "files/file_error.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace koebe::io {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

TEST(FileIdentity, ManyNamesOfOneFile)
{
    const TemporaryFolder folder;
    const fs::path file = folder.write("file", ""), other = folder.write("other", "");
    fs::create_directory(folder.path() / "sub");
    fs::create_directory_symlink("sub", folder.path() / "sub_link");
    fs::create_symlink("file", folder.path() / "link");
    fs::create_symlink("../link", folder.path() / "sub" / "link_to_link");
    fs::create_hard_link(file, folder.path() / "hard");
    for (const char* name :
         {"file", "./file", "sub/../file", "link", "sub/link_to_link", "sub_link/link_to_link", "hard"}) {
        EXPECT_TRUE(same_file(file, folder.path() / name)) << name;
        EXPECT_TRUE(same_file(folder.path() / name, file)) << name;
        EXPECT_FALSE(same_file(other, folder.path() / name)) << name;
    }
}

TEST(FileIdentity, NamesOfWhatIsNotThereYet)
{
    const TemporaryFolder folder;
    fs::create_directory(folder.path() / "sub");
    fs::create_directory_symlink("sub", folder.path() / "sub_link");
    fs::create_symlink("new", folder.path() / "dangling");
    const fs::path file = folder.path() / "new";
    for (const char* name : {"new", "./new", "sub/../new", "dangling"})
        EXPECT_TRUE(same_file(file, folder.path() / name)) << name;
    EXPECT_TRUE(same_file(folder.path() / "sub" / "a", folder.path() / "sub_link" / "a"));
    for (const char* name : {"sub/new", "new2", "missing/new"})
        EXPECT_FALSE(same_file(file, folder.path() / name)) << name;
    EXPECT_FALSE(same_file(file, folder.write("there", "")));
    EXPECT_EQ(folder.file_count(), 4u);
}

TEST(FileIdentity, LetterCaseIsThatOfTheFileSystem)
{
    const TemporaryFolder folder;
    const bool expected = [&] {
        folder.write("probe", "");
        return fs::exists(folder.path() / "PROBE");
    }();
    EXPECT_EQ(same_file(folder.path() / "name.obj", folder.path() / "NAME.OBJ"), expected);
    EXPECT_EQ(folder.file_count(), 1u);
}

TEST(FileIdentity, OpenFilesAndTheNullDevice)
{
    const TemporaryFolder folder;
    const fs::path file = folder.write("file", "");
    const int descriptor = ::open(file.c_str(), O_RDONLY);
    EXPECT_TRUE(is_open_as(descriptor, file));
    EXPECT_FALSE(is_open_as(descriptor, folder.path() / "new"));
    ::close(descriptor);
    EXPECT_FALSE(same_file("/dev/null", "/dev/null"));  // it keeps nothing
}

TEST(FileIdentity, LinksInACircleAreAnError)
{
    const TemporaryFolder folder;
    fs::create_symlink("b", folder.path() / "a");
    fs::create_symlink("a", folder.path() / "b");
    EXPECT_THROW(followed(folder.path() / "a"), FileError);
    EXPECT_THROW(require_writable(folder.path() / "a"), FileError);
    EXPECT_THROW(AtomicFile{folder.path() / "a"}, FileError);
    EXPECT_TRUE(fs::is_symlink(folder.path() / "a"));
}

}  // namespace
}  // namespace koebe::io
