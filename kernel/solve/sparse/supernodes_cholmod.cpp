#include <cholmod.h>

#include "kernel/core/error.h"
#include "kernel/solve/sparse/cholmod_view.h"
#include "kernel/solve/sparse/supernodes.h"

namespace lissom {
namespace {

// CHOLMOD's settings and scratch memory, and the pattern it finds.
class Analysis {
  public:
    explicit Analysis(const SymmetricMatrix& matrix) {
        cholmod_start(&common_);
        common_.print = 0;
        common_.supernodal = CHOLMOD_SUPERNODAL;
        common_.nmethods = 1;
        common_.method[0].ordering = CHOLMOD_AMD;
        common_.postorder = 1;
        cholmod_sparse view = cholmod_view(matrix);
        factor_ = cholmod_analyze(&view, &common_);
    }
    ~Analysis() {
        cholmod_free_factor(&factor_, &common_);
        cholmod_finish(&common_);
    }
    Analysis(const Analysis&) = delete;
    Analysis& operator=(const Analysis&) = delete;

    const cholmod_factor& factor() const {
        if (common_.status == CHOLMOD_OUT_OF_MEMORY || common_.status == CHOLMOD_TOO_LARGE) {
            throw Error(ErrorCode::memory_limit,
                        "the factor of the linear system does not fit into memory; use a smaller "
                        "region or mesh");
        }
        if (!factor_) throw Error(ErrorCode::internal, "CHOLMOD could not analyse the matrix");
        return *factor_;
    }

  private:
    cholmod_common common_{};
    cholmod_factor* factor_ = nullptr;
};

std::vector<Index> copy(const void* data, std::size_t count) {
    const auto* begin = static_cast<const Index*>(data);
    return {begin, begin + count};
}

}  // namespace

Supernodes analyze_supernodes(const SymmetricMatrix& matrix) {
    const Analysis analysis(matrix);
    const cholmod_factor& factor = analysis.factor();
    return {copy(factor.super, factor.nsuper + 1), copy(factor.pi, factor.nsuper + 1),
            copy(factor.px, factor.nsuper + 1), copy(factor.s, factor.ssize),
            copy(factor.Perm, factor.n)};
}

}  // namespace lissom
