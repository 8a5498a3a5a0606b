// Text to a file, with numbers that read back to the same bits.
#pragma once

#include "io/atomic_file.h"

#include <charconv>
#include <string>
#include <string_view>

namespace koebe::io {

/// Writes through a buffer that stays in the processor's cache. Numbers are the shortest that read back to the same
/// value. The text is complete after flush().
class TextWriter {
public:
    explicit TextWriter(AtomicFile& file) : file_(file), buffer_(std::size_t{1} << 16, '\0') {}

    void add(char c)
    {
        reserve(1);
        buffer_[used_++] = c;
    }
    void add(std::string_view word)
    {
        for (const char c : word) add(c);
    }
    template <typename Number>
    void add_number(Number number)
    {
        reserve(longest_number);
        char* const here = buffer_.data() + used_;
        used_ += static_cast<std::size_t>(std::to_chars(here, here + longest_number, number).ptr - here);
    }
    /// @throws FileError
    void flush()
    {
        file_.write({buffer_.data(), used_});
        used_ = 0;
    }

private:
    static constexpr std::size_t longest_number = 24;  // bytes: -1.2345678901234567e-308
    void reserve(std::size_t count)
    {
        if (used_ + count > buffer_.size()) flush();
    }

    AtomicFile& file_;
    std::string buffer_;
    std::size_t used_ = 0;
};

}  // namespace koebe::io
