#include "kernel/deform/system/firm_factor.h"

#include "kernel/core/error.h"

namespace lissom {
namespace {

void enlarge_diagonal(SymmetricMatrix& matrix, double share) {
    for (Index i = 0; i < matrix.size(); ++i) matrix.value[matrix.begin[i]] *= 1.0 + share;
}

}  // namespace

bool factor_firmly(SymmetricMatrix& matrix, const std::function<void()>& factor) {
    bool enlarged = false;
    for (const double share : {1e-12, 1e-10, 1e-8, 1e-6}) {
        try {
            factor();
            return enlarged;
        } catch (const Error& error) {
            if (error.code() != ErrorCode::not_positive_definite) throw;
        }
        enlarge_diagonal(matrix, share);
        enlarged = true;
    }
    factor();
    return enlarged;
}

void factor_firmly(SparseSystem& system, SymmetricMatrix& matrix, const Context& context) {
    system.analyze(matrix, context);
    factor_firmly(matrix, [&] { system.factor(matrix, context); });
}

}  // namespace lissom
