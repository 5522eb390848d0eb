#include "kernel/deform/frame_loops.h"

#include "kernel/core/lanes.h"

namespace lissom {
namespace {

using Row = Lanes<double>;

LISSOM_INLINE const Row& row_of(const Vec4& v) {
    return *reinterpret_cast<const Row*>(v.data());
}
LISSOM_INLINE Row& row_of(Vec4& v) {
    return *reinterpret_cast<Row*>(v.data());
}
LISSOM_INLINE const Row& column_of(const PaddedMat3& m, int column) {
    return *reinterpret_cast<const Row*>(m.data() + 4 * column);
}

LISSOM_INLINE void store(const Row& row, double* at) {
    for (int d = 0; d < 3; ++d) at[d] = row[d];
}

// sum += m v.
LISSOM_INLINE void add_product(const PaddedMat3& m, const Row& v, Row& sum) {
    for (int d = 0; d < 3; ++d) sum += v[d] * column_of(m, d);
}

LISSOM_INLINE void evaluate_rows(const BasisLoop& loop, const Index* vertex, Vec4* x, Index begin,
                                 Index end) {
    for (Index r = begin; r < end; ++r) {
        Row sum{};
        for (std::size_t h = 0; h < loop.count; ++h) {
            const double* weight = loop.weight[h][r].data();
            const double* transform = loop.transform[h].data();
            for (int d = 0; d < 4; ++d) {
                sum += weight[d] * *reinterpret_cast<const Row*>(transform + 4 * d);
            }
        }
        row_of(x[vertex[r]]) = sum;
    }
}

LISSOM_INLINE void gather_rows(const GradientLoop& loop, const Index* vertex, const Vec4* x,
                               Mat3* m, Index begin, Index end) {
    for (Index r = begin; r < end; ++r) {
        const Index i = vertex[r];
        Row column[3];
        const Row own = row_of(x[i]);
        for (int d = 0; d < 3; ++d) column[d] = loop.self[i][d] * own;
        for (Index e = loop.ring_begin[i]; e < loop.ring_begin[i + 1]; ++e) {
            const Row other = row_of(x[loop.neighbor[e]]);
            const double* p = loop.stencil[e].data();
            for (int d = 0; d < 3; ++d) column[d] += p[d] * other;
        }
        for (int d = 0; d < 3; ++d) store(column[d], m[r - begin].data() + 3 * d);
    }
}

LISSOM_INLINE void bend_rows(const EnergyLoop& loop, const PaddedMat3* s, const Vec4* x, Vec4* u,
                             Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
        const Row own = row_of(x[i]);
        Row sum{};
        for (Index e = loop.ring_begin[i]; e < loop.ring_begin[i + 1]; ++e) {
            Row difference = own;
            difference -= row_of(x[loop.neighbor[e]]);
            sum += loop.coefficient[e] * difference;
        }
        Row turned{};
        add_product(s[i], row_of(loop.laplacian[i]), turned);
        sum -= turned;
        row_of(u[i]) = loop.row_weight[i] * sum;
    }
}

LISSOM_INLINE void descend_rows(const EnergyLoop& loop, const PaddedMat3* s, const Vec4* x,
                                const Vec4* u, const Index* vertex, Vec3* r, Index begin,
                                Index end) {
    for (Index row = begin; row < end; ++row) {
        const Index i = vertex[row];
        const Row own = row_of(x[i]), own_rest = row_of(loop.rest[i]), own_u = row_of(u[i]);
        Row sum{};
        add_product(s[i], row_of(loop.edge_sum[i]), sum);
        for (Index e = loop.ring_begin[i]; e < loop.ring_begin[i + 1]; ++e) {
            const Index j = loop.neighbor[e];
            const double weight = loop.edge_weight[e];
            Row edge = own_rest;
            edge -= row_of(loop.rest[j]);
            add_product(s[j], 0.5 * weight * edge, sum);
            Row difference = own, bent = own_u;
            difference -= row_of(x[j]);
            sum -= weight * difference;
            bent -= row_of(u[j]);
            sum -= loop.coefficient[e] * bent;
        }
        store(sum, r[row].data());
    }
}

#ifdef LISSOM_HAS_AVX2_PATH
LISSOM_AVX2 void evaluate_with_avx2(const BasisLoop& loop, const Index* vertex, Vec4* x,
                                    Index begin, Index end) {
    evaluate_rows(loop, vertex, x, begin, end);
}
LISSOM_AVX2 void gather_with_avx2(const GradientLoop& loop, const Index* vertex, const Vec4* x,
                                  Mat3* m, Index begin, Index end) {
    gather_rows(loop, vertex, x, m, begin, end);
}
LISSOM_AVX2 void bend_with_avx2(const EnergyLoop& loop, const PaddedMat3* s, const Vec4* x, Vec4* u,
                                Index begin, Index end) {
    bend_rows(loop, s, x, u, begin, end);
}
LISSOM_AVX2 void descend_with_avx2(const EnergyLoop& loop, const PaddedMat3* s, const Vec4* x,
                                   const Vec4* u, const Index* vertex, Vec3* r, Index begin,
                                   Index end) {
    descend_rows(loop, s, x, u, vertex, r, begin, end);
}
#endif

}  // namespace

void BasisLoop::evaluate(const Index* vertex, Vec4* x, Index begin, Index end) const {
#ifdef LISSOM_HAS_AVX2_PATH
    if (has_avx2()) return evaluate_with_avx2(*this, vertex, x, begin, end);
#endif
    evaluate_rows(*this, vertex, x, begin, end);
}

void GradientLoop::gather(const Index* vertex, const Vec4* x, Mat3* m, Index begin,
                          Index end) const {
#ifdef LISSOM_HAS_AVX2_PATH
    if (has_avx2()) return gather_with_avx2(*this, vertex, x, m, begin, end);
#endif
    gather_rows(*this, vertex, x, m, begin, end);
}

void EnergyLoop::bend(const PaddedMat3* s, const Vec4* x, Vec4* u, Index begin, Index end) const {
#ifdef LISSOM_HAS_AVX2_PATH
    if (has_avx2()) return bend_with_avx2(*this, s, x, u, begin, end);
#endif
    bend_rows(*this, s, x, u, begin, end);
}

void EnergyLoop::descend(const PaddedMat3* s, const Vec4* x, const Vec4* u, const Index* vertex,
                         Vec3* r, Index begin, Index end) const {
#ifdef LISSOM_HAS_AVX2_PATH
    if (has_avx2()) return descend_with_avx2(*this, s, x, u, vertex, r, begin, end);
#endif
    descend_rows(*this, s, x, u, vertex, r, begin, end);
}

}  // namespace lissom
