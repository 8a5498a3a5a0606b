// What is fuzzed: each takes any bytes, and throws for a finding. The sanitizers find the rest.
#pragma once

#include "program.h"

#include <string_view>

namespace koebe::fuzz {

/// A surface and options through the whole road (program.h); the map's promises are checked (promise_check.h).
void fuzz_uniformize(Bytes bytes);

/// A surface through one of the quick functions, at high speed.
void fuzz_arrays(Bytes bytes);

/// A surface, often closed and with handles, through a map to another domain than the disk, or into parts.
void fuzz_domains(Bytes bytes);
inline constexpr int domain_choices = 30;

/// The first byte names the format, the others are a file of it.
void fuzz_read(Bytes bytes);

using Target = void (*)(Bytes);

/// @return null if there is no target of that name (uniformize, arrays, domains, read)
Target target_of(std::string_view name);

/// Whether the target's bytes are a program, so that a mutator may work on its records.
bool takes_a_program(Target target);

}  // namespace koebe::fuzz
