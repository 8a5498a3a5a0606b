// Writes text to a file, with numbers that read back to the same bits.
#pragma once

#include "core/types.h"
#include "files/atomic_file.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>

namespace koebe::io {

/// Writes the shortest text that reads back to the same value, as std::to_chars does; three times as fast for numbers
/// of few decimals, as coordinates in files are.
/// @param here room for 24 characters @return the end of the text
char* write_number(char* here, double number);

/// Writes through a buffer that stays in the processor's cache. Numbers are the shortest that read back to the same
/// value. The text is complete after flush().
class TextWriter {
public:
    explicit TextWriter(AtomicFile& file) : file_(&file), buffer_(std::size_t{1} << 16, '\0') {}

    void add(char c)
    {
        reserve(1);
        buffer_[used_++] = c;
    }
    void add(std::string_view word)
    {
        reserve(word.size());
        if (word.size() > buffer_.size()) return file_->write(word);  // the buffer of a piece has grown
        if (!word.empty()) std::memcpy(buffer_.data() + used_, word.data(), word.size());
        used_ += word.size();
    }
    template <typename Number>
    void add_number(Number number)
    {
        reserve(longest_number);
        char* const here = buffer_.data() + used_;
        if constexpr (std::is_same_v<Number, double>)
            used_ += static_cast<std::size_t>(write_number(here, number) - here);
        else
            used_ += static_cast<std::size_t>(std::to_chars(here, here + longest_number, number).ptr - here);
    }
    /// Adds the same whole number twice, with a character between.
    void add_twice(Index number, char between)
    {
        reserve(2 * longest_number + 1);
        const std::size_t begin = used_;
        add_number(number);
        const std::size_t length = used_ - begin;
        buffer_[used_] = between;
        std::memcpy(buffer_.data() + used_ + 1, buffer_.data() + begin, length);
        used_ += length + 1;
    }
    /// Calls add(text, i) for each i < count to add item i, on this thread's share of threads, in blocks. The text is
    /// the same as one item after another would give.
    void add_each(Index count, const std::function<void(TextWriter& text, Index i)>& add, std::size_t at_a_time = 8192);
    /// @throws FileError
    void flush()
    {
        file_->write({buffer_.data(), used_});
        used_ = 0;
    }

private:
    static constexpr std::size_t longest_number = 24;  // bytes: -1.2345678901234567e-308

    /// For a piece, which is kept until its turn.
    TextWriter() : buffer_(std::size_t{1} << 18, '\0') {}
    /// Makes room for so many characters. With a file the buffer does not grow.
    void reserve(std::size_t count)
    {
        if (used_ + count <= buffer_.size()) return;
        if (file_)
            flush();
        else
            buffer_.resize(std::max(2 * buffer_.size(), used_ + count));
    }

    AtomicFile* file_ = nullptr;
    std::string buffer_;
    std::size_t used_ = 0;
};

}  // namespace koebe::io
