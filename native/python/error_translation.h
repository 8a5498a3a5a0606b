// Translates C++ exceptions to Python's.
#pragma once

namespace koebe::python {

/// A KoebeError becomes the class of the same name in koebe.errors, with .elements and, for TopologyError, .kind.
/// Missing memory or a missing thread becomes MemoryError; any other exception becomes SolverError.
void translate_errors();

}  // namespace koebe::python
