#include "targets.h"

namespace koebe::fuzz {

Target target_of(std::string_view name)
{
    if (name == "uniformize") return fuzz_uniformize;
    if (name == "arrays") return fuzz_arrays;
    if (name == "domains") return fuzz_domains;
    if (name == "read") return fuzz_read;
    return nullptr;
}

bool takes_a_program(Target target) { return target != fuzz_read; }

}  // namespace koebe::fuzz
