// Functions of C++20 that the sources use and libc++ 13 of Debian's emscripten lacks: std::ranges' algorithms, to_chars
// and from_chars for doubles, bit_cast [ISO/IEC 14882:2020, 25, 20.19, 26.5.3]. web.cmake includes it before each
// source.
#pragma once

#include <version>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 14000

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>

namespace std {

/// The fewest of 15 to 17 digits that read back to the same number.
inline to_chars_result to_chars(char* first, char* last, double number)
{
    char digits[32];
    int length = 0;
    for (int precision = numeric_limits<double>::digits10; precision <= numeric_limits<double>::max_digits10;
         ++precision) {
        length = snprintf(digits, sizeof digits, "%.*g", precision, number);
        if (strtod(digits, nullptr) == number) break;
    }
    if (length > last - first) return {last, errc::value_too_large};
    return {copy_n(digits, length, first), errc{}};
}

inline from_chars_result from_chars(const char* first, const char* last, double& number)
{
    // strtod would take blanks and a plus sign before the number, and 0x.
    const string word(first, find_if(first, last, [](char c) { return c == 'x' || c == 'X'; }));
    if (word.empty() || word[0] == '+' || isspace(static_cast<unsigned char>(word[0])) != 0)
        return {first, errc::invalid_argument};
    char* end = nullptr;
    const double read = strtod(word.c_str(), &end);
    if (end == word.c_str()) return {first, errc::invalid_argument};
    if (isinf(read) && isdigit(static_cast<unsigned char>(word.back())) != 0)
        return {first + (end - word.c_str()), errc::result_out_of_range};
    number = read;
    return {first + (end - word.c_str()), errc{}};
}

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept
{
    return __builtin_bit_cast(To, from);
}

template <class Array>
unique_ptr<Array> make_unique_for_overwrite(size_t count)
{
    return unique_ptr<Array>(new remove_extent_t<Array>[count]);
}

namespace ranges {
namespace koebe_detail {

/// Compares projected elements.
template <class Compare, class Project>
auto projected_order(Compare& compare, Project& project)
{
    return [&](auto&& a, auto&& b) -> bool {
        return std::invoke(compare, std::invoke(project, std::forward<decltype(a)>(a)),
                           std::invoke(project, std::forward<decltype(b)>(b)));
    };
}

/// Tests projected elements.
template <class Test, class Project>
auto projected_test(Test& test, Project& project)
{
    return [&](auto&& a) -> bool { return std::invoke(test, std::invoke(project, std::forward<decltype(a)>(a))); };
}

}  // namespace koebe_detail

// Algorithms that take an order, a test or a value: their projection comes last.
#define KOEBE_ORDER_OF_RANGE(name)                                                                                     \
    template <class Range, class Compare = less, class Project = identity>                                             \
    auto name(Range&& range, Compare compare = {}, Project project = {})                                               \
    {                                                                                                                  \
        return std::name(std::begin(range), std::end(range), koebe_detail::projected_order(compare, project));         \
    }
KOEBE_ORDER_OF_RANGE(sort)
KOEBE_ORDER_OF_RANGE(stable_sort)
KOEBE_ORDER_OF_RANGE(min_element)
KOEBE_ORDER_OF_RANGE(max_element)
#undef KOEBE_ORDER_OF_RANGE

#define KOEBE_TEST_OF_RANGE(name)                                                                                      \
    template <class Iterator, class Test, class Project = identity>                                                    \
    requires input_or_output_iterator<Iterator>                                                                        \
    auto name(Iterator first, Iterator last, Test test, Project project = {})                                          \
    {                                                                                                                  \
        return std::name(first, last, koebe_detail::projected_test(test, project));                                    \
    }                                                                                                                  \
    template <class Range, class Test, class Project = identity>                                                       \
    auto name(Range&& range, Test test, Project project = {})                                                          \
    {                                                                                                                  \
        return std::name(std::begin(range), std::end(range), koebe_detail::projected_test(test, project));             \
    }
KOEBE_TEST_OF_RANGE(all_of)
KOEBE_TEST_OF_RANGE(any_of)
KOEBE_TEST_OF_RANGE(none_of)
KOEBE_TEST_OF_RANGE(find_if)
KOEBE_TEST_OF_RANGE(count_if)
#undef KOEBE_TEST_OF_RANGE

template <class Iterator, class Value, class Project = identity>
requires input_or_output_iterator<Iterator>
auto find(Iterator first, Iterator last, const Value& value, Project project = {})
{
    return std::find_if(first, last, [&](auto&& a) { return std::invoke(project, a) == value; });
}

template <class Range, class Value, class Project = identity>
auto find(Range&& range, const Value& value, Project project = {})
{
    return ranges::find(std::begin(range), std::end(range), value, project);
}

template <class Range, class Value, class Project = identity>
auto count(Range&& range, const Value& value, Project project = {})
{
    return std::count_if(std::begin(range), std::end(range),
                         [&](auto&& a) { return std::invoke(project, a) == value; });
}

template <class Range, class Value, class Compare = less, class Project = identity>
auto lower_bound(Range&& range, const Value& value, Compare compare = {}, Project project = {})
{
    return std::lower_bound(std::begin(range), std::end(range), value,
                            [&](auto&& a, const Value& b) { return std::invoke(compare, std::invoke(project, a), b); });
}

template <class Range, class Value, class Compare = less, class Project = identity>
auto upper_bound(Range&& range, const Value& value, Compare compare = {}, Project project = {})
{
    return std::upper_bound(std::begin(range), std::end(range), value,
                            [&](const Value& a, auto&& b) { return std::invoke(compare, a, std::invoke(project, b)); });
}

template <class Range, class Value, class Compare = less, class Project = identity>
bool binary_search(Range&& range, const Value& value, Compare compare = {}, Project project = {})
{
    const auto at = ranges::lower_bound(range, value, compare, project);
    return at != std::end(range) && !std::invoke(compare, value, std::invoke(project, *at));
}

template <class Range>
auto min(Range&& range)
{
    return *ranges::min_element(range);
}

template <class Range>
auto max(Range&& range)
{
    return *ranges::max_element(range);
}

template <class Iterator>
struct min_max_result {
    Iterator min, max;
};

template <class Range, class Compare = less, class Project = identity>
auto minmax_element(Range&& range, Compare compare = {}, Project project = {})
{
    const auto [least, most] =
        std::minmax_element(std::begin(range), std::end(range), koebe_detail::projected_order(compare, project));
    return min_max_result<decltype(std::begin(range))>{least, most};
}

template <class Range, class Iterator, class Compare = less, class Project = identity>
void nth_element(Range&& range, Iterator nth, Compare compare = {}, Project project = {})
{
    std::nth_element(std::begin(range), nth, std::end(range), koebe_detail::projected_order(compare, project));
}

template <class Range, class Output, class Test>
void copy_if(Range&& range, Output output, Test test)
{
    std::copy_if(std::begin(range), std::end(range), output, [&](auto&& a) -> bool { return std::invoke(test, a); });
}

// Algorithms of a whole range.
#define KOEBE_OF_RANGE(name)                                                                                           \
    template <class Range, class... Words>                                                                             \
    auto name(Range&& range, Words&&... words)                                                                         \
    {                                                                                                                  \
        return std::name(std::begin(range), std::end(range), std::forward<Words>(words)...);                           \
    }
KOEBE_OF_RANGE(adjacent_find)
KOEBE_OF_RANGE(copy)
KOEBE_OF_RANGE(move)
KOEBE_OF_RANGE(transform)
KOEBE_OF_RANGE(fill)
KOEBE_OF_RANGE(replace)
KOEBE_OF_RANGE(replace_if)
KOEBE_OF_RANGE(reverse)
#undef KOEBE_OF_RANGE

template <class Range, class Iterator>
void rotate(Range&& range, Iterator middle)
{
    std::rotate(std::begin(range), middle, std::end(range));
}

template <class A, class B>
bool includes(A&& a, B&& b)
{
    return std::includes(std::begin(a), std::end(a), std::begin(b), std::end(b));
}

#define KOEBE_SET_OF_RANGES(name)                                                                                      \
    template <class A, class B, class Output>                                                                          \
    void name(A&& a, B&& b, Output output)                                                                             \
    {                                                                                                                  \
        std::name(std::begin(a), std::end(a), std::begin(b), std::end(b), output);                                     \
    }
KOEBE_SET_OF_RANGES(set_difference)
KOEBE_SET_OF_RANGES(set_intersection)
KOEBE_SET_OF_RANGES(set_union)
#undef KOEBE_SET_OF_RANGES

}  // namespace ranges
}  // namespace std

#endif
