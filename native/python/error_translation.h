// C++ exceptions as Python has them.
#pragma once

namespace koebe::python {

/// A KoebeError becomes the class of the same name in koebe.errors, with .elements and, for TopologyError, .kind;
/// memory or a thread that cannot be had becomes MemoryError; what no code here throws on purpose becomes SolverError.
void translate_errors();

}  // namespace koebe::python
