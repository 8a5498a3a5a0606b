// The fuzzers without libFuzzer: replays inputs, writes the seeds, and runs random inputs at the speed of a release
// build, which has no sanitizer but finds wrong answers as well.
#include "mutator.h"
#include "seeds.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>

using namespace koebe::fuzz;
namespace fs = std::filesystem;

namespace {

constexpr const char* usage = "koebe_fuzz run TARGET FILE ...\n"
                              "koebe_fuzz seeds TARGET FOLDER\n"
                              "koebe_fuzz storm TARGET COUNT SEED FOLDER [CORPUS ...]\n"
                              "    COUNT random inputs, half of them changed ones of CORPUS; findings go to FOLDER\n";

std::vector<std::uint8_t> read_bytes(const fs::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const fs::path& path, const std::vector<std::uint8_t>& bytes)
{
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// @return whether the target found nothing
bool passes(Target target, const std::vector<std::uint8_t>& bytes, const std::string& name)
{
    try {
        target(bytes);
        return true;
    } catch (const std::exception& error) {
        std::printf("%s: %s\n", name.c_str(), error.what());
        std::fflush(stdout);
        return false;
    }
}

std::vector<std::uint8_t> random_file(const std::vector<Seed>& seeds, Random& random)
{
    std::vector<std::uint8_t> bytes = seeds[random.below(seeds.size())].bytes;
    for (std::size_t i = 1 + random.below(6); i > 0 && bytes.size() > 1; --i) {
        const std::size_t at = random.below(bytes.size());
        if (random.below(3) == 0)
            bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at));
        else if (random.below(3) == 0)
            bytes.resize(1 + at);
        else
            bytes[at] = static_cast<std::uint8_t>(random.below(2) ? random.next() : bytes[random.below(bytes.size())]);
    }
    return bytes;
}

using Corpus = std::vector<std::vector<std::uint8_t>>;

Corpus read_corpus(std::span<const std::string> folders)
{
    std::vector<fs::path> paths;
    for (const std::string& folder : folders)
        for (const auto& entry : fs::directory_iterator(folder)) paths.push_back(entry.path());
    std::ranges::sort(paths);
    Corpus corpus;
    for (const fs::path& path : paths) corpus.push_back(read_bytes(path));
    return corpus;
}

std::vector<std::uint8_t> random_input(Target target, const std::vector<Seed>& seeds, const Corpus& corpus,
                                       Random& random)
{
    if (!takes_a_program(target)) return random_file(seeds, random);
    if (corpus.empty() || random.below(2) == 0) return random_program(random);
    const auto& first = corpus[random.below(corpus.size())];
    if (random.below(4) > 0) return mutate(first, random);
    return cross_over(first, corpus[random.below(corpus.size())], random);
}

int storm(Target target, std::size_t count, std::size_t first, const fs::path& folder, const Corpus& corpus)
{
    const std::vector<Seed> seeds = seeds_of(target);
    int findings = 0;
    const fs::path current = folder / "current";  // stays if the process dies
    for (std::size_t i = first; i < first + count; ++i) {
        Random random(i);
        const auto bytes = random_input(target, seeds, corpus, random);
        if (std::getenv("KOEBE_FUZZ_KEEP")) write_bytes(current, bytes);
        const std::string name = "finding-" + std::to_string(i);
        if (passes(target, bytes, name)) continue;
        write_bytes(folder / name, bytes);
        ++findings;
    }
    std::printf("%zu inputs, %d findings\n", count, findings);
    return findings == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv)
{
    const std::vector<std::string> words(argv + 1, argv + argc);
    const Target target = words.size() >= 3 ? target_of(words[1]) : nullptr;
    if (target && words[0] == "run") {
        bool all = true;
        for (std::size_t i = 2; i < words.size(); ++i) all = passes(target, read_bytes(words[i]), words[i]) && all;
        return all ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    if (target && words[0] == "seeds") {
        for (const Seed& seed : seeds_of(target)) write_bytes(fs::path(words[2]) / seed.name, seed.bytes);
        return EXIT_SUCCESS;
    }
    if (target && words[0] == "storm" && words.size() >= 5)
        return storm(target, std::stoul(words[2]), std::stoul(words[3]), words[4],
                     read_corpus(std::span(words).subspan(5)));
    std::fputs(usage, stderr);
    return 2;
}
