#include "schottky/group_word.h"

#include <algorithm>
#include <cstdlib>

namespace koebe {
namespace {

LinearFractional of_letter(int letter, const std::vector<LinearFractional>& generators)
{
    const LinearFractional& generator = generators[std::abs(letter) - 1];
    return letter > 0 ? generator : generator.inverse();
}

}  // namespace

void append_letter(GroupWord& word, int letter)
{
    if (letter == 0) return;
    if (!word.empty() && word.back() == -letter)
        word.pop_back();
    else
        word.push_back(letter);
}

GroupWord product(GroupWord left, const GroupWord& right)
{
    for (const int letter : right) append_letter(left, letter);
    return left;
}

GroupWord inverse_of(GroupWord word)
{
    std::ranges::reverse(word);
    for (int& letter : word) letter = -letter;
    return word;
}

Complex applied(const GroupWord& word, const std::vector<LinearFractional>& generators, Complex z)
{
    for (std::size_t i = word.size(); i-- > 0;) z = of_letter(word[i], generators)(z);
    return z;
}

Circle applied(const GroupWord& word, const std::vector<LinearFractional>& generators, Circle circle)
{
    for (std::size_t i = word.size(); i-- > 0;) circle = of_letter(word[i], generators)(circle);
    return circle;
}

}  // namespace koebe
