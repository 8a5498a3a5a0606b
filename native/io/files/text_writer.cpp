#include "files/text_writer.h"

#include "execution/thread_share.h"

#include <cmath>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace koebe::io {
namespace {

constexpr double millionths = 1e6;
constexpr int decimals = 6;
constexpr double least = 0.1;  // from here on a plain number is at most as long as one with an exponent
constexpr double most = 1e9;   // so that there are at most 15 digits

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

/// Lets threads write the pieces of a text in order.
class Turns {
public:
    /// Calls write() when all pieces before `begin` are written; not at all after another one has failed.
    template <class Write>
    void write_in_order(std::size_t begin, std::size_t end, const Write& write)
    {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return failed_ || written_ == begin; });
        if (failed_) return;
        lock.unlock();
        write();
        lock.lock();
        written_ = end;
        changed_.notify_all();
    }
    void fail()
    {
        const std::scoped_lock lock(mutex_);
        failed_ = true;
        changed_.notify_all();
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::size_t written_ = 0;
    bool failed_ = false;
};

}  // namespace

/// Pieces are started in order, so the piece whose turn it is, is always being made.
void TextWriter::add_each(Index count, const std::function<void(TextWriter& text, Index i)>& add, std::size_t at_a_time)
{
    if (ThreadShare::here() == 1 || static_cast<std::size_t>(count) <= at_a_time) {
        for (Index i = 0; i < count; ++i) add(*this, i);
        return;
    }
    flush();
    Turns turns;
    in_pieces(static_cast<std::size_t>(count), at_a_time, [&](std::size_t begin, std::size_t end) {
        try {
            TextWriter piece;
            for (std::size_t i = begin; i < end; ++i) add(piece, static_cast<Index>(i));
            turns.write_in_order(begin, end, [&] { file_->write({piece.buffer_.data(), piece.used_}); });
        } catch (...) {
            turns.fail();
            throw;
        }
    });
}

/// Two different decimal numbers of at most 15 digits are different doubles. So if a number of millionths equals the
/// value, no other text is shorter. It equals the value if its quotient does, which is rounded once, as a reader
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
