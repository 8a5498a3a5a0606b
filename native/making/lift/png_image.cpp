#include "lift/png_image.h"

#include "core/errors.h"

#include <boost/crc.hpp>

#include <limits>
#include <memory>
#include <string_view>

// The library's only use of stb_image: PNG from memory, its functions private to this file.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS (1 << 16)
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb/stb_image.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace koebe {
namespace {

constexpr std::int64_t most_pixels = 64'000'000;
constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";

std::uint32_t big_endian(std::string_view bytes)
{
    std::uint32_t number = 0;
    for (int k = 0; k < 4; ++k) number = number << 8 | static_cast<unsigned char>(bytes[k]);
    return number;
}

/// Checks length and check sum of each chunk up to the last: stb_image does not (PNG, 3rd edition, section 5.3).
void require_sound_chunks(std::string_view rest)
{
    constexpr std::size_t frame = 12;  // length, type, check sum
    std::string_view type;
    do {
        if (rest.size() < frame || big_endian(rest) > rest.size() - frame) throw InputError("the PNG ends early");
        const std::size_t length = big_endian(rest);
        boost::crc_32_type sum;
        sum.process_bytes(rest.data() + 4, length + 4);
        if (sum.checksum() != big_endian(rest.substr(length + 8)))
            throw InputError("the PNG is damaged: a check sum is wrong");
        type = rest.substr(4, 4);
        rest.remove_prefix(length + frame);
    } while (type != "IEND");
}

}  // namespace

GreyImage parse_png(const std::string& bytes)
{
    if (!bytes.starts_with(signature)) throw InputError("the file is no PNG");
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw InputError("the PNG is larger than two gigabytes");
    require_sound_chunks(std::string_view(bytes).substr(signature.size()));
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    GreyImage image;
    int channels = 0;
    if (!stbi_info_from_memory(data, size, &image.width, &image.height, &channels) || image.width < 1 ||
        image.height < 1)
        throw InputError(std::string("the PNG is damaged: ") + stbi_failure_reason());
    if (static_cast<std::int64_t>(image.width) * image.height > most_pixels)
        throw InputError("the image has over 64 million pixels");
    const std::unique_ptr<stbi_us, void (*)(void*)> pixels(
        stbi_load_16_from_memory(data, size, &image.width, &image.height, &channels, STBI_grey_alpha), stbi_image_free);
    if (!pixels) throw InputError(std::string("the PNG is damaged: ") + stbi_failure_reason());
    image.grey.resize(static_cast<std::size_t>(image.width) * image.height);
    for (std::size_t i = 0; i < image.grey.size(); ++i) {
        const std::uint64_t grey = pixels.get()[2 * i], opaque = pixels.get()[2 * i + 1];
        image.grey[i] = static_cast<std::uint16_t>((grey * opaque + 32767) / 65535);
    }
    return image;
}

}  // namespace koebe
