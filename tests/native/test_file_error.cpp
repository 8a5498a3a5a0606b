// Laws of file errors: the type tells whether a retry can help, the message tells the reason.
#include "files/file_error.h"

#include <gtest/gtest.h>

#include <cerrno>

namespace koebe {
namespace {

/// What io::fail says for this reason. Another type than Error ends the test.
template <typename Error>
std::string message_of(int error_number)
{
    try {
        io::fail("cannot read a.obj", error_number);
    } catch (const Error& error) {
        return error.what();
    }
}

TEST(FileError, TooLittleMemoryIsNoFaultOfTheFile)
{
    EXPECT_EQ(message_of<OutOfMemory>(ENOMEM), "cannot read a.obj (Cannot allocate memory)");
    EXPECT_EQ(message_of<FileError>(ENOENT), "cannot read a.obj (No such file or directory)");
}

}  // namespace
}  // namespace koebe
