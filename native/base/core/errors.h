// Typed errors. Each carries the offending elements, so that a caller can show or select them.
#pragma once

#include "core/api.h"
#include "core/elements.h"
#include "core/types.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace koebe {

/// Base of all errors that the library throws on purpose.
class KoebeError : public std::runtime_error {
public:
    explicit KoebeError(const std::string& message) : std::runtime_error(message) {}
    KoebeError(const std::string& message, ElementKind kind, std::vector<Index> elements)
        : std::runtime_error(message), elements_of_(kind), elements_(std::move(elements))
    {
    }
    ~KoebeError() override = default;
    /// The error's public name, as printed by the command and used in Python.
    virtual const char* name() const noexcept { return "KoebeError"; }
    const std::vector<Index>& elements() const noexcept { return elements_; }
    /// The kind of the elements.
    ElementKind elements_of() const noexcept { return elements_of_; }

private:
    ElementKind elements_of_ = ElementKind::none;
    std::vector<Index> elements_;
};

/// The arrays are not a mesh: wrong shape, index out of range, NaN or infinite coordinate.
class InputError : public KoebeError {
public:
    using KoebeError::KoebeError;
    const char* name() const noexcept override { return "InputError"; }
};

enum class TopologyKind {
    closed,              ///< no boundary loop
    genus,               ///< a handle; elements: vertices of a handle loop
    nonmanifold_edge,    ///< elements: edges with three or more faces
    nonmanifold_vertex,  ///< the faces around a vertex form more than one fan; elements: such vertices
    nonorientable,       ///< elements: the edge that cannot be made consistent
    disconnected,        ///< elements: faces outside the largest component
};

KOEBE_API const char* to_string(TopologyKind kind) noexcept;
/// The kind of elements that an error of this kind lists.
KOEBE_API ElementKind elements_of(TopologyKind kind) noexcept;

/// The mesh is not a connected, orientable surface of genus 0 with boundary.
class TopologyError : public KoebeError {
public:
    TopologyError(TopologyKind kind, const std::string& message, std::vector<Index> elements = {})
        : KoebeError(message, koebe::elements_of(kind), std::move(elements)), kind_(kind)
    {
    }
    const char* name() const noexcept override { return "TopologyError"; }
    TopologyKind kind() const noexcept { return kind_; }

private:
    TopologyKind kind_;
};

/// A linear system that could not be solved.
class SolverError : public KoebeError {
public:
    using KoebeError::KoebeError;
    const char* name() const noexcept override { return "SolverError"; }
};

/// A computation does not fit into the memory. It is refused before it starts.
class OutOfMemory : public SolverError {
public:
    using SolverError::SolverError;
};

/// The caller asked to stop.
class Cancelled : public KoebeError {
public:
    Cancelled() : KoebeError("cancelled by the caller") {}
    const char* name() const noexcept override { return "Cancelled"; }
};

}  // namespace koebe
