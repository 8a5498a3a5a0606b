// A target as libFuzzer wants it. KOEBE_FUZZ_TARGET is its name.
#include "mutator.h"
#include "targets.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>

using namespace koebe::fuzz;

namespace {

const Target target = target_of(KOEBE_FUZZ_TARGET);

std::size_t put(const std::vector<std::uint8_t>& bytes, std::uint8_t* data, std::size_t most)
{
    const std::size_t size = std::min(bytes.size(), most);
    std::copy_n(bytes.begin(), size, data);
    return size;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        target({data, size});
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", KOEBE_FUZZ_TARGET, error.what());
        std::abort();
    }
    return 0;
}

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed)
{
    Random random(seed);
    if (!takes_a_program(target) || random.below(8) == 0) return LLVMFuzzerMutate(data, size, most);
    return put(random.below(64) == 0 ? random_program(random) : mutate({data, size}, random), data, most);
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* first, std::size_t first_size,
                                                 const std::uint8_t* second, std::size_t second_size, std::uint8_t* out,
                                                 std::size_t most, unsigned seed)
{
    Random random(seed);
    if (takes_a_program(target)) return put(cross_over({first, first_size}, {second, second_size}, random), out, most);
    std::vector<std::uint8_t> bytes(first, first + random.below(first_size + 1));
    const std::size_t from = random.below(second_size + 1);
    bytes.insert(bytes.end(), second + from, second + second_size);
    return put(bytes, out, most);
}
