#include "batch/content_hash.h"

#include "batch/path_text.h"
#include "files/file_error.h"

#include <sodium/crypto_hash_sha256.h>

#include <cerrno>
#include <fstream>
#include <vector>

namespace koebe::batch {
namespace {

constexpr std::size_t piece = std::size_t{1} << 20;  // bytes per read

class Sha256 {
public:
    Sha256() { crypto_hash_sha256_init(&state_); }

    void add(const char* bytes, std::size_t count)
    {
        crypto_hash_sha256_update(&state_, reinterpret_cast<const unsigned char*>(bytes), count);
    }

    std::string digits()
    {
        unsigned char hash[crypto_hash_sha256_BYTES];
        crypto_hash_sha256_final(&state_, hash);
        std::string text;
        for (const unsigned char byte : hash) {
            text += "0123456789abcdef"[byte >> 4];
            text += "0123456789abcdef"[byte & 15];
        }
        return text;
    }

private:
    crypto_hash_sha256_state state_;
};

}  // namespace

std::string sha256_of_file(const std::filesystem::path& path)
{
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    Sha256 hash;
    std::vector<char> buffer(piece);
    while (file) {
        file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
        hash.add(buffer.data(), static_cast<std::size_t>(file.gcount()));
    }
    if (!file.eof()) io::fail("cannot read " + utf8(path), errno != 0 ? errno : EIO);
    return hash.digits();
}

std::string sha256_of_text(const std::string& text)
{
    Sha256 hash;
    hash.add(text.data(), text.size());
    return hash.digits();
}

}  // namespace koebe::batch
