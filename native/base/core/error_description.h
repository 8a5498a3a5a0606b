// Describes an exception by its C++ type. A program and a shared library that it calls have different types.
#pragma once

#include "core/api.h"
#include "core/errors.h"

#include <exception>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace koebe {

struct ErrorDescription {
    std::string name;  ///< as KoebeError::name(); "MemoryError" or "SolverError" for other exceptions
    std::string message;
    bool is_koebe_error = false;
    std::vector<Index> elements = {};
    const char* elements_of = nullptr;
    const char* topology_kind = nullptr;  ///< set for a TopologyError
};

/// Describes an exception by the types of the calling side. Returns nothing if that side does not know the type.
inline std::optional<ErrorDescription> describe_error(const std::exception_ptr& pointer)
{
    const ErrorDescription no_memory{"MemoryError", "the mesh needs more memory than there is"};
    try {
        if (pointer) std::rethrow_exception(pointer);
    } catch (const KoebeError& error) {
        const auto* topology = dynamic_cast<const TopologyError*>(&error);
        return ErrorDescription{error.name(),
                                error.what(),
                                true,
                                error.elements(),
                                to_string(error.elements_of()),
                                topology ? to_string(topology->kind()) : nullptr};
    } catch (const std::bad_alloc&) {
        return no_memory;
    } catch (const std::length_error&) {  // a container beyond what can be addressed
        return no_memory;
    } catch (const std::system_error&) {  // no thread
        return no_memory;
    } catch (const std::exception& error) {
        return ErrorDescription{"SolverError", std::string("internal error: ") + error.what()};
    } catch (...) {
        return {};
    }
    return {};
}

/// Describes an exception by the types of the library. If both sides link the C++ runtime, each side has its own
/// identity of a class. Then a `catch` here does not see an exception that was thrown there.
KOEBE_API std::optional<ErrorDescription> describe_error_of_library(const std::exception_ptr& pointer);

}  // namespace koebe
