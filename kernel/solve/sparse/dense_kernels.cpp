#include "kernel/solve/sparse/dense_kernels.h"

#include "kernel/solve/sparse/dense_loops.h"

namespace lissom {
namespace {

// Accumulators of four columns fit into the registers: 16 of two numbers, or 16 of four.
constexpr int kRowsAnywhere = 1;

void multiply_anywhere(const DenseProduct& product) {
    multiply_dense<kRowsAnywhere>(product);
}

Index eliminate_anywhere(const DensePanel& panel) {
    return eliminate_dense<kRowsAnywhere>(panel);
}

void solve_rows_anywhere(const DensePanel& panel, Index begin, Index end) {
    solve_rows_dense<kRowsAnywhere>(panel, begin, end);
}

#ifdef LISSOM_HAS_AVX2_PATH
constexpr int kRowsWithAvx2 = 3;

LISSOM_AVX2 void multiply_with_avx2(const DenseProduct& product) {
    multiply_dense<kRowsWithAvx2>(product);
}

LISSOM_AVX2 Index eliminate_with_avx2(const DensePanel& panel) {
    return eliminate_dense<kRowsWithAvx2>(panel);
}

LISSOM_AVX2 void solve_rows_with_avx2(const DensePanel& panel, Index begin, Index end) {
    solve_rows_dense<kRowsWithAvx2>(panel, begin, end);
}
#endif

}  // namespace

Processor best_processor() {
    return has_avx2() ? Processor::avx2 : Processor::any;
}

DenseKernels dense_kernels([[maybe_unused]] Processor processor) {
#ifdef LISSOM_HAS_AVX2_PATH
    if (processor == Processor::avx2) {
        return {multiply_with_avx2, eliminate_with_avx2, solve_rows_with_avx2};
    }
#endif
    return {multiply_anywhere, eliminate_anywhere, solve_rows_anywhere};
}

}  // namespace lissom
