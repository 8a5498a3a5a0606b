// A small generator whose numbers are the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>

namespace koebe::fuzz {

/// SplitMix64 (Steele, Lea and Flood 2014).
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next()
    {
        std::uint64_t x = state_ += 0x9e3779b97f4a7c15u;
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        return x ^ (x >> 31);
    }
    std::size_t below(std::size_t count) { return count ? static_cast<std::size_t>(next() % count) : 0; }
    /// In [-1, 1).
    double symmetric() { return static_cast<double>(next() >> 11) * 0x1p-52 - 1.0; }

private:
    std::uint64_t state_;
};

}  // namespace koebe::fuzz
