// Replays the kept inputs: those that reach much of the code, and everything that was once a finding.
#include "mutator.h"
#include "seeds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

using namespace koebe::fuzz;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> inputs_of(const std::string& target)
{
    std::vector<fs::path> paths;
    for (const char* folder : {"corpus", "findings"})
        if (const fs::path path = fs::path(KOEBE_FUZZ_FOLDER) / folder / target; fs::exists(path))
            for (const auto& entry : fs::directory_iterator(path)) paths.push_back(entry.path());
    std::ranges::sort(paths);
    return paths;
}

}  // namespace

class FuzzTarget : public testing::TestWithParam<const char*> {};

TEST_P(FuzzTarget, keeps_its_promises_on_the_kept_inputs)
{
    const std::vector<fs::path> paths = inputs_of(GetParam());
    EXPECT_FALSE(paths.empty());
    for (const fs::path& path : paths) {
        std::ifstream file(path, std::ios::binary);
        const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
        EXPECT_NO_THROW(target_of(GetParam())(bytes)) << path.parent_path().filename() << '/' << path.filename();
    }
}

TEST_P(FuzzTarget, keeps_its_promises_on_the_seeds)
{
    for (const Seed& seed : seeds_of(target_of(GetParam())))
        EXPECT_NO_THROW(target_of(GetParam())(seed.bytes)) << seed.name;
}

INSTANTIATE_TEST_SUITE_P(Fuzz, FuzzTarget, testing::Values("uniformize", "arrays", "domains", "read"),
                         [](const auto& info) { return std::string(info.param); });
