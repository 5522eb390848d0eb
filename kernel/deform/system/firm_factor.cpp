#include "kernel/deform/system/firm_factor.h"

#include "kernel/core/error.h"

namespace lissom {
namespace {

void enlarge_diagonal(SymmetricMatrix& matrix, double share) {
    for (Index i = 0; i < matrix.size(); ++i) matrix.value[matrix.begin[i]] *= 1.0 + share;
}

}  // namespace

void factor_firmly(SparseSystem& system, SymmetricMatrix& matrix, const Context& context) {
    system.analyze(matrix, context);
    for (const double share : {1e-12, 1e-10, 1e-8, 1e-6}) {
        try {
            return system.factor(matrix, context);
        } catch (const Error& error) {
            if (error.code() != ErrorCode::not_positive_definite) throw;
        }
        enlarge_diagonal(matrix, share);
    }
    system.factor(matrix, context);
}

}  // namespace lissom
