/// Our matrices as CHOLMOD sees them; private to kernel/cholmod.
#pragma once

#include "kernel/solve/sparse/sparse_matrix.h"

struct cholmod_sparse_struct;

namespace lissom {

/// A view of `matrix`, to which CHOLMOD does not write.
cholmod_sparse_struct cholmod_view(const SymmetricMatrix& matrix);

}  // namespace lissom
