#include "kernel/cholmod/cholmod_view.h"

#include <cholmod.h>

namespace lissom {

cholmod_sparse_struct cholmod_view(const SymmetricMatrix& matrix) {
    cholmod_sparse view{};
    view.nrow = view.ncol = matrix.size();
    view.nzmax = matrix.row.size();
    view.p = const_cast<Index*>(matrix.begin.data());
    view.i = const_cast<Index*>(matrix.row.data());
    view.x = const_cast<double*>(matrix.value.data());
    view.stype = -1;
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = 1;
    view.packed = 1;
    return view;
}

}  // namespace lissom
