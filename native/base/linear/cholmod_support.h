// CHOLMOD's C structures under C++ ownership. For the .cpp files of this folder only.
#pragma once

#include "core/errors.h"
#include "core/not_copied.h"
#include "core/types.h"

#include <cholmod.h>

#include <functional>
#include <memory>
#include <new>
#include <string>

namespace koebe::detail {

/// A started workspace with CHOLMOD's defaults, except for a supernodal L L' and no output.
class CholmodCommon : NotCopied {
public:
    CholmodCommon()
    {
        cholmod_start(&common_);
        common_.supernodal = CHOLMOD_SUPERNODAL;
        common_.final_ll = 1;
        common_.print = 0;
        common_.error_handler = nullptr;
    }
    ~CholmodCommon() { cholmod_finish(&common_); }
    cholmod_common* get() { return &common_; }
    cholmod_common* operator->() { return &common_; }

    void require(bool success, const char* step)
    {
        if (success && common_.status == CHOLMOD_OK) return;
        if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
        if (common_.status == CHOLMOD_TOO_LARGE)
            throw OutOfMemory(std::string("sparse factorization: ") + step + ": more numbers than 32 bits can count");
        throw SolverError(std::string("sparse factorization: ") + step + " failed, status " +
                          std::to_string(common_.status));
    }

private:
    cholmod_common common_{};
};

using Factor = std::unique_ptr<cholmod_factor, std::function<void(cholmod_factor*)>>;

inline Factor own(cholmod_factor* factor, CholmodCommon& common)
{
    return {factor, [&common](cholmod_factor* f) { cholmod_free_factor(&f, common.get()); }};
}

/// A view without copying. CHOLMOD does not write to it, though its type is not const.
inline cholmod_sparse view(const SparseMatrix& matrix, int symmetry)
{
    cholmod_sparse result{};
    result.nrow = matrix.rows();
    result.ncol = matrix.cols();
    result.nzmax = matrix.nonZeros();
    result.p = const_cast<Index*>(matrix.outerIndexPtr());
    result.i = const_cast<Index*>(matrix.innerIndexPtr());
    result.x = const_cast<double*>(matrix.valuePtr());
    result.stype = symmetry;
    result.itype = CHOLMOD_INT;
    result.xtype = CHOLMOD_REAL;
    result.dtype = CHOLMOD_DOUBLE;
    result.sorted = 1;
    result.packed = 1;
    return result;
}

}  // namespace koebe::detail
