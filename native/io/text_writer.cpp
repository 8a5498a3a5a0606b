#include "io/text_writer.h"

#include <cmath>
#include <cstdint>

namespace koebe::io {
namespace {

constexpr double millionths = 1e6;
constexpr int decimals = 6;
constexpr double least = 0.1;  // from here on a plain number is no longer than one with an exponent
constexpr double most = 1e9;   // so that there are 15 digits at most

/// The digits of a number of millionths, without zeros at the end.
char* write_millionths(char* here, std::uint64_t count)
{
    constexpr std::uint64_t one = 1'000'000;
    here = std::to_chars(here, here + 10, count / one).ptr;
    *here++ = '.';
    auto rest = static_cast<std::uint32_t>(count % one);
    for (int k = decimals - 1; k >= 0; --k, rest /= 10) here[k] = static_cast<char>('0' + rest % 10);
    here += decimals;
    while (here[-1] == '0') --here;
    return here;
}

}  // namespace

/// Of two different decimal numbers of 15 digits at most no two are the same double. So if a number of millionths is
/// the value, there is no shorter text; and it is the value if its quotient is, which is rounded once, as a reader
/// rounds. Whole numbers are left to std::to_chars, which writes some with an exponent.
char* write_number(char* here, double number)
{
    constexpr int longest = 24;
    const double size = std::abs(number);
    if (size >= least && size < most) {
        const auto count = static_cast<std::uint64_t>(std::llrint(size * millionths));
        if (static_cast<double>(count) / millionths == size && count % 1'000'000 != 0) {
            if (number < 0.0) *here++ = '-';
            return write_millionths(here, count);
        }
    }
    return std::to_chars(here, here + longest, number).ptr;
}

}  // namespace koebe::io
