#include "cli/files/text_file.h"

#include "files/file_error.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace koebe::cli {

std::string read_text(const std::string& path)
{
    std::ifstream file(std::filesystem::path(path), std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (!file.good() && !file.eof()) io::fail("cannot read " + path, errno);
    return text;
}

std::string read_words(const std::string& path)
{
    std::string text = read_text(path);
    std::ranges::replace(text, ',', ' ');
    return text;
}

}  // namespace koebe::cli
