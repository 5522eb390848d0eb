#include "kernel/solve/sparse/dense_kernels.h"

#include "kernel/solve/sparse/dense_loops.h"

namespace lissom {
namespace {

// Accumulators of four columns fit into the registers: 16 of two numbers, or 16 of four.
using TileAnywhere = TileOf<FourDoubles, 1>;

void multiply_anywhere(const DenseProduct& product) {
    multiply_dense<TileAnywhere>(product);
}

Index eliminate_anywhere(const DensePanel& panel) {
    return eliminate_dense<TileAnywhere>(panel);
}

void solve_rows_anywhere(const DensePanel& panel, Index begin, Index end) {
    solve_rows_dense<TileAnywhere>(panel, begin, end);
}

#ifdef LISSOM_HAS_AVX2_PATH
using TileWithAvx2 = TileOf<FourDoubles, 3>;

LISSOM_AVX2 void multiply_with_avx2(const DenseProduct& product) {
    multiply_dense<TileWithAvx2>(product);
}

LISSOM_AVX2 Index eliminate_with_avx2(const DensePanel& panel) {
    return eliminate_dense<TileWithAvx2>(panel);
}

LISSOM_AVX2 void solve_rows_with_avx2(const DensePanel& panel, Index begin, Index end) {
    solve_rows_dense<TileWithAvx2>(panel, begin, end);
}

// Twelve sums are enough for two units of four cycles each.
using TileWithAvx512 = TileOf<EightDoubles, 3>;

LISSOM_AVX512 void multiply_with_avx512(const DenseProduct& product) {
    multiply_dense<TileWithAvx512>(product);
}

LISSOM_AVX512 Index eliminate_with_avx512(const DensePanel& panel) {
    return eliminate_dense<TileWithAvx512>(panel);
}

LISSOM_AVX512 void solve_rows_with_avx512(const DensePanel& panel, Index begin, Index end) {
    solve_rows_dense<TileWithAvx512>(panel, begin, end);
}
#endif

}  // namespace

Processor best_processor() {
    if (has_avx512()) return Processor::avx512;
    return has_avx2() ? Processor::avx2 : Processor::any;
}

DenseKernels dense_kernels([[maybe_unused]] Processor processor) {
#ifdef LISSOM_HAS_AVX2_PATH
    if (processor == Processor::avx512) {
        return {multiply_with_avx512, eliminate_with_avx512, solve_rows_with_avx512};
    }
    if (processor == Processor::avx2) {
        return {multiply_with_avx2, eliminate_with_avx2, solve_rows_with_avx2};
    }
#endif
    return {multiply_anywhere, eliminate_anywhere, solve_rows_anywhere};
}

}  // namespace lissom
