#include "mutator.h"

#include <algorithm>

namespace koebe::fuzz {
namespace {

using Edit = std::array<std::uint8_t, edit_bytes>;

struct Records {
    std::array<std::uint8_t, header_bytes> header{};
    std::vector<Edit> edits;
};

Records records_of(Bytes program)
{
    Records records;
    std::ranges::copy(program.first(std::min(program.size(), header_bytes)), records.header.begin());
    for (std::size_t at = header_bytes; at < program.size() && records.edits.size() < most_edits; at += edit_bytes) {
        Edit& edit = records.edits.emplace_back();
        std::ranges::copy(program.subspan(at, std::min(edit_bytes, program.size() - at)), edit.begin());
    }
    return records;
}

std::vector<std::uint8_t> bytes_of(const Records& records)
{
    std::vector<std::uint8_t> bytes(records.header.begin(), records.header.end());
    for (const Edit& edit : records.edits) bytes.insert(bytes.end(), edit.begin(), edit.end());
    return bytes;
}

std::uint8_t any_byte(Random& random) { return static_cast<std::uint8_t>(random.next()); }

Edit random_edit(Random& random)
{
    Edit edit;
    std::ranges::generate(edit, [&] { return any_byte(random); });
    const int kinds = random.below(10) == 0 ? edit_kind_count() : first_breaking_edit();
    edit[0] = static_cast<std::uint8_t>(random.below(static_cast<std::size_t>(kinds)));
    if (random.below(2) == 0) edit[5] = static_cast<std::uint8_t>(static_cast<int>(random.below(17)) - 8);
    return edit;
}

void change(Records& records, Random& random)
{
    auto& edits = records.edits;
    const std::size_t at = random.below(edits.size());
    const auto there = edits.begin() + static_cast<std::ptrdiff_t>(at);
    const std::size_t what = random.below(8);
    if (what == 0) {
        records.header[random.below(header_bytes)] = any_byte(random);
    } else if (what <= 2 || edits.empty()) {
        edits.insert(there, random_edit(random));
    } else if (what == 3) {
        edits.erase(there);
    } else if (what == 4) {
        std::swap(edits[at], edits[random.below(edits.size())]);
    } else if (what == 5) {
        const Edit again = edits[at];
        edits.insert(there, again);
    } else if (what == 6) {
        edits[at][1 + random.below(edit_bytes - 1)] = any_byte(random);
    } else {
        edits[at] = random_edit(random);
    }
    if (edits.size() > most_edits) edits.resize(most_edits);
}

}  // namespace

std::vector<std::uint8_t> mutate(Bytes program, Random& random)
{
    Records records = records_of(program);
    for (std::size_t i = 1 + random.below(4); i > 0; --i) change(records, random);
    return bytes_of(records);
}

std::vector<std::uint8_t> cross_over(Bytes first, Bytes second, Random& random)
{
    Records records = records_of(first);
    const Records other = records_of(second);
    records.edits.resize(random.below(records.edits.size() + 1));
    const std::size_t from = random.below(other.edits.size() + 1);
    records.edits.insert(records.edits.end(), other.edits.begin() + static_cast<std::ptrdiff_t>(from),
                         other.edits.end());
    if (records.edits.size() > most_edits) records.edits.resize(most_edits);
    return bytes_of(records);
}

std::vector<std::uint8_t> random_program(Random& random)
{
    Records records;
    std::ranges::generate(records.header, [&] { return any_byte(random); });
    if (random.below(2) == 0)  // the default options; the last byte is the target's choice
        std::fill(records.header.begin() + base_bytes, records.header.end() - 1, std::uint8_t{0});
    for (std::size_t i = random.below(random.below(4) == 0 ? most_edits : 6); i > 0; --i)
        records.edits.push_back(random_edit(random));
    return bytes_of(records);
}

}  // namespace koebe::fuzz
