#include "tests/unit/solve/sparse/cholmod_oracle.h"

#include <cholmod.h>

#include "kernel/cholmod/cholmod_view.h"
#include "tests/unit/support.h"

namespace lissom::test {
namespace {

std::vector<Index> copied_indices(const void* data, std::size_t count) {
    const auto* begin = static_cast<const Index*>(data);
    return {begin, begin + count};
}

}  // namespace

Supernodes cholmod_supernodes(const SymmetricMatrix& matrix) {
    cholmod_common common;
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_AMD;
    common.postorder = 1;
    cholmod_sparse view = cholmod_view(matrix);
    cholmod_factor* factor = cholmod_analyze(&view, &common);
    REQUIRE(factor);
    Supernodes nodes;
    nodes.super = copied_indices(factor->super, factor->nsuper + 1);
    nodes.first_row = copied_indices(factor->pi, factor->nsuper + 1);
    nodes.first_value = copied_indices(factor->px, factor->nsuper + 1);
    nodes.row = copied_indices(factor->s, factor->ssize);
    nodes.permutation = copied_indices(factor->Perm, factor->n);
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
    return nodes;
}

}  // namespace lissom::test
