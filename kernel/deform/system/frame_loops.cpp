#include "kernel/deform/system/frame_loops.h"

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

// sum += m w, for the four numbers at w.
LISSOM_INLINE void add_transformed(const Mat4& m, const double* w, Row& sum) {
    for (int d = 0; d < 4; ++d) {
        sum += w[d] * *reinterpret_cast<const Row*>(m.data() + 4 * d);
    }
}

LISSOM_INLINE void evaluate_row(const BasisLoop& loop, Index r, Row& sum) {
    sum = Row{};
    for (std::size_t h = 0; h < loop.count; ++h) {
        add_transformed(loop.transform[h], loop.weight[h][r].data(), sum);
    }
}

LISSOM_INLINE void evaluate_rows(const BasisLoop& loop, Vec4* x, Index begin, Index end) {
    for (Index r = begin; r < end; ++r) {
        Row sum;
        evaluate_row(loop, r, sum);
        row_of(x[r - begin]) = sum;
    }
}

template <bool moved>
LISSOM_INLINE void place_rows(const BasisLoop& loop, const BasisLoop::Places& to, Index begin,
                              Index end) {
    const Vec4 origin = padded(to.origin);
    for (Index r = begin; r < end; ++r) {
        if (to.row[r] == kNoIndex) continue;
        Row sum;
        evaluate_row(loop, r, sum);
        const double* p = to.rest[r].data();
        const Row rest{p[0], p[1], p[2], 0.0};
        sum += rest;
        const double homogeneous[] = {p[0], p[1], p[2], 1.0};
        if constexpr (moved) add_transformed(to.shift, homogeneous, sum);
        sum += row_of(origin);
        store(sum, to.out[to.row[r]].data());
    }
}

LISSOM_INLINE void place_rows(const BasisLoop& loop, const BasisLoop::Places& to, Index begin,
                              Index end) {
    to.shift.isZero(0.0) ? place_rows<false>(loop, to, begin, end)
                         : place_rows<true>(loop, to, begin, end);
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

template <bool turned>
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
        if constexpr (turned) {
            Row kept{};
            add_product(s[i], row_of(loop.laplacian[i]), kept);
            sum -= kept;
        }
        row_of(u[i]) = loop.row_weight[i] * sum;
    }
}

template <bool turned>
LISSOM_INLINE void descend_rows(const EnergyLoop& loop, const PaddedMat3* s, const Vec4* x,
                                const Vec4* u, const Index* vertex, Vec3* r, Index begin,
                                Index end) {
    for (Index row = begin; row < end; ++row) {
        const Index i = vertex[row];
        const Row own = row_of(x[i]), own_rest = row_of(loop.rest[i]), own_u = row_of(u[i]);
        Row sum{};
        if constexpr (turned) add_product(s[i], row_of(loop.edge_sum[i]), sum);
        for (Index e = loop.ring_begin[i]; e < loop.ring_begin[i + 1]; ++e) {
            const Index j = loop.neighbor[e];
            const double weight = loop.edge_weight[e];
            if constexpr (turned) {
                Row edge = own_rest;
                edge -= row_of(loop.rest[j]);
                add_product(s[j], 0.5 * weight * edge, sum);
            }
            Row difference = own, bent = own_u;
            difference -= row_of(x[j]);
            sum -= weight * difference;
            bent -= row_of(u[j]);
            sum -= loop.coefficient[e] * bent;
        }
        store(sum, r[row].data());
    }
}

LISSOM_INLINE void fit_rows(const EnergyLoop& loop, const Vec4* x, const Index* vertex, Mat3* m,
                            Index begin, Index end) {
    for (Index row = begin; row < end; ++row) {
        const Index i = vertex[row];
        const Row own = row_of(x[i]), own_rest = row_of(loop.rest[i]);
        Row column[3] = {}, bent{};
        for (Index e = loop.ring_begin[i]; e < loop.ring_begin[i + 1]; ++e) {
            const Index j = loop.neighbor[e];
            Row difference = own, edge = own_rest;
            difference -= row_of(x[j]);
            edge -= row_of(loop.rest[j]);
            const Row weighted = 0.5 * loop.edge_weight[e] * edge;
            for (int d = 0; d < 3; ++d) column[d] += weighted[d] * difference;
            bent += loop.coefficient[e] * difference;
        }
        const Row rest_bent = loop.row_weight[i] * row_of(loop.laplacian[i]);
        for (int d = 0; d < 3; ++d) {
            column[d] += rest_bent[d] * bent;
            store(column[d], m[row - begin].data() + 3 * d);
        }
    }
}

#ifdef LISSOM_HAS_AVX2_PATH
LISSOM_AVX2 void evaluate_with_avx2(const BasisLoop& loop, Vec4* x, Index begin, Index end) {
    evaluate_rows(loop, x, begin, end);
}
LISSOM_AVX2 void place_with_avx2(const BasisLoop& loop, const BasisLoop::Places& to, Index begin,
                                 Index end) {
    place_rows(loop, to, begin, end);
}
LISSOM_AVX2 void gather_with_avx2(const GradientLoop& loop, const Index* vertex, const Vec4* x,
                                  Mat3* m, Index begin, Index end) {
    gather_rows(loop, vertex, x, m, begin, end);
}
LISSOM_AVX2 void bend_with_avx2(const EnergyLoop& loop, const PaddedMat3* s, const Vec4* x, Vec4* u,
                                Index begin, Index end) {
    s ? bend_rows<true>(loop, s, x, u, begin, end) : bend_rows<false>(loop, s, x, u, begin, end);
}
LISSOM_AVX2 void descend_with_avx2(const EnergyLoop& loop, const PaddedMat3* s, const Vec4* x,
                                   const Vec4* u, const Index* vertex, Vec3* r, Index begin,
                                   Index end) {
    s ? descend_rows<true>(loop, s, x, u, vertex, r, begin, end)
      : descend_rows<false>(loop, s, x, u, vertex, r, begin, end);
}
LISSOM_AVX2 void fit_with_avx2(const EnergyLoop& loop, const Vec4* x, const Index* vertex, Mat3* m,
                               Index begin, Index end) {
    fit_rows(loop, x, vertex, m, begin, end);
}
#endif

}  // namespace

void BasisLoop::evaluate(Vec4* x, Index begin, Index end) const {
#ifdef LISSOM_HAS_AVX2_PATH
    if (has_avx2()) return evaluate_with_avx2(*this, x, begin, end);
#endif
    evaluate_rows(*this, x, begin, end);
}

void BasisLoop::place(const Places& places, Index begin, Index end) const {
#ifdef LISSOM_HAS_AVX2_PATH
    if (has_avx2()) return place_with_avx2(*this, places, begin, end);
#endif
    place_rows(*this, places, begin, end);
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
    s ? bend_rows<true>(*this, s, x, u, begin, end) : bend_rows<false>(*this, s, x, u, begin, end);
}

void EnergyLoop::descend(const PaddedMat3* s, const Vec4* x, const Vec4* u, const Index* vertex,
                         Vec3* r, Index begin, Index end) const {
#ifdef LISSOM_HAS_AVX2_PATH
    if (has_avx2()) return descend_with_avx2(*this, s, x, u, vertex, r, begin, end);
#endif
    s ? descend_rows<true>(*this, s, x, u, vertex, r, begin, end)
      : descend_rows<false>(*this, s, x, u, vertex, r, begin, end);
}

void EnergyLoop::fit(const Vec4* x, const Index* vertex, Mat3* m, Index begin, Index end) const {
#ifdef LISSOM_HAS_AVX2_PATH
    if (has_avx2()) return fit_with_avx2(*this, x, vertex, m, begin, end);
#endif
    fit_rows(*this, x, vertex, m, begin, end);
}

}  // namespace lissom
