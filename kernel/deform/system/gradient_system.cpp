#include "kernel/deform/system/gradient_system.h"

#include <algorithm>
#include <map>
#include <utility>

#include "kernel/core/extended.h"
#include "kernel/core/large_pages.h"
#include "kernel/deform/patch/row_accumulator.h"

namespace lissom {

// Rows of A and of both couplings for one chunk of free vertices.
struct GradientSystem::SystemRows {
    std::vector<Index> matrix_begin{0}, matrix_column;
    std::vector<double> matrix_value;
    std::vector<Index> position_begin{0}, position_column;
    std::vector<double> position_value;
    std::vector<Index> gradient_begin{0}, gradient_column;
    std::vector<Vec3> gradient_value;
};

namespace {

// sum_b w_ab (M_a - M_b) as coefficients of unknown or known positions, and of known gradients.
struct CoherenceRows {
    std::vector<Index> begin{0}, column;
    std::vector<Vec3> value;
    std::vector<Index> known_begin{0}, known_column;
    std::vector<double> known_value;
};

class Assembler {
  public:
    using SystemRows = GradientSystem::SystemRows;

    Assembler(const WorkingPatch& work, const GradientStencils& gradients, const KnownMask& known,
              const DeformOptions& options)
        : work_(work),
          rings_(work.rings),
          geometry_(work.geometry),
          laplacian_(work.laplacian),
          gradients_(gradients),
          known_(known),
          options_(options),
          delta_(rings_.size(), Vec3::Zero()),
          row_of_(rings_.size(), kNoIndex) {
        for (Index i = 0; i < rings_.size(); ++i) {
            if (has_row(i)) delta_[i] = laplacian_.apply(rings_, gradients.displaced_rest, i);
        }
        for (const GradientTie& tie : work.gradient_ties) ties_of_.emplace(tie.vertex, &tie);
    }

    const std::vector<Index>& row_of() const { return row_of_; }

    std::vector<Index> number_free_vertices() {
        std::vector<Index> free;
        for (Index i = 0; i < rings_.size(); ++i) {
            if (known_.position[i]) continue;
            row_of_[i] = count_of(free);
            free.push_back(i);
        }
        return free;
    }

    // Chunk by chunk: together they are the largest part of an assembly, too large to copy. Only
    // those of `needed` vertices.
    void build_coherence(const std::vector<char>& needed, const Context& context) {
        const Index grain = assembly_grain(rings_.size());
        coherence_.resize(chunk_count(rings_.size()));
        context.parallel_for(0, rings_.size(), grain, [&](Index begin, Index end) {
            coherence_[begin / grain] = coherence_rows(needed, begin, end, context);
        });
    }

    std::vector<SystemRows> build_rows(const std::vector<Index>& free,
                                       const Context& context) const {
        const auto rows = count_of(free);
        const Index grain = assembly_grain(rows);
        std::vector<SystemRows> parts(chunk_count(rows));
        context.parallel_for(0, rows, grain, [&](Index begin, Index end) {
            parts[begin / grain] = system_rows(free, begin, end, context);
        });
        return parts;
    }

  private:
    static std::size_t chunk_count(Index size) {
        return (size + assembly_grain(size) - 1) / assembly_grain(size);
    }

    bool has_gradient(Index i) const { return known_.gradient[i] || gradients_.defined[i]; }
    bool has_row(Index i) const { return has_gradient(i) && laplacian_.weight[i] > 0.0; }

    double coherence_of(Index a, Index b, Index entry) const {
        return work_.stiffness_between(a, b) * edge_coherence(options_, geometry_.cotangent[entry]);
    }

    // A normal point whose vertex has no gradient after all: nothing depends on it.
    bool is_idle(Index i) const {
        const Index point = i - work_.patch.first_normal_point();
        if (point < 0 || i >= work_.patch.surface_count) return false;
        return !gradients_.defined[at(work_.patch.normal_points[at(point)])];
    }

    // Calls use(b, weight) for every pair (a, b) of SF in Eq 2.7 if both have gradients.
    template <typename Use>
    void for_each_pair(Index a, RowAccumulator<double>& pairs, const Use& use) const {
        if (options_.coherence == 2) {
            const double second = second_ring_coherence(options_);
            for (const Index b : rings_.ring(a)) {
                for (const Index c : rings_.ring(b)) {
                    if (c != a && !is_neighbor(a, c)) pairs.add(c, 0.0);
                }
            }
            pairs.drain([&](Index c, double) {
                if (has_gradient(c)) use(c, second * work_.stiffness_between(a, c));
            });
        }
        for (Index e = rings_.begin[a]; e < rings_.begin[a + 1]; ++e) {
            const Index b = rings_.neighbor[e];
            if (has_gradient(b)) use(b, coherence_of(a, b, e));
        }
    }

    bool is_neighbor(Index a, Index c) const {
        const std::span<const Index> ring = rings_.ring(a);
        return std::binary_search(ring.begin(), ring.end(), c);
    }

    // How many columns the rows of coherence over one ring can have at most.
    std::size_t max_columns(const std::vector<char>& needed, Index begin, Index end) const {
        std::size_t most = 0;
        for (Index a = begin; a < end; ++a) {
            if (!needed[at(a)]) continue;
            most += 1 + rings_.count(a);
            for (const Index b : rings_.ring(a)) most += rings_.count(b);
        }
        return most;
    }

    void add_gradient(Index a, double weight, RowAccumulator<Vec3>& row) const {
        row.add(a, weight * gradients_.self[a]);
        for (Index e = rings_.begin[a]; e < rings_.begin[a + 1]; ++e) {
            row.add(rings_.neighbor[e], weight * gradients_.neighbor[e]);
        }
    }

    // Adds the difference of the gradient at `a` from those of its pairs and ties, known ones
    // apart.
    void add_coherence_row(Index a, RowAccumulator<Vec3>& row, RowAccumulator<double>& known_row,
                           RowAccumulator<double>& pairs) const {
        double total = 0.0;
        for_each_pair(a, pairs, [&](Index b, double weight) {
            total += weight;
            if (known_.gradient[b]) {
                known_row.add(b, -weight);
            } else {
                add_gradient(b, -weight, row);
            }
        });
        const double tie_unit = work_.gradient_unit() / options_.coherence_weight;
        const auto [first, last] = ties_of_.equal_range(a);
        for (auto tie = first; tie != last; ++tie) {
            const double weight = tie->second->weight * tie_unit;
            total += weight;
            known_row.add(tie->second->anchor, -weight);
        }
        if (total > 0.0) add_gradient(a, total, row);
    }

    CoherenceRows coherence_rows(const std::vector<char>& needed, Index begin, Index end,
                                 const Context& context) const {
        CoherenceRows rows;
        const std::size_t most = max_columns(needed, begin, end);
        rows.column.reserve(most);
        rows.value.reserve(most);
        RowAccumulator<Vec3> row(rings_.size());
        RowAccumulator<double> known_row(rings_.size()), pairs(rings_.size());
        for (Index a = begin; a < end; ++a) {
            context.checkpoint();
            if (needed[at(a)] && gradients_.defined[a] && !known_.gradient[a]) {
                add_coherence_row(a, row, known_row, pairs);
            }
            row.drain([&](Index c, const Vec3& v) {
                rows.column.push_back(c);
                rows.value.push_back(v);
            });
            known_row.drain([&](Index c, double v) {
                rows.known_column.push_back(c);
                rows.known_value.push_back(v);
            });
            rows.begin.push_back(count_of(rows.column));
            rows.known_begin.push_back(count_of(rows.known_column));
        }
        return rows;
    }

    // Coefficient of neighbour `entry` of a, or of a itself, in the residual D(x)_a - M_a delta_a.
    double residual_self(Index a) const {
        const double l = laplacian_.self[a];
        return known_.gradient[a] ? l : l - gradients_.self[a].dot(delta_[a]);
    }
    double residual_neighbor(Index a, Index entry) const {
        const double l = laplacian_.neighbor[entry];
        return known_.gradient[a] ? l : l - gradients_.neighbor[entry].dot(delta_[a]);
    }

    // Whether the row of vertex `i` needs column `k`: of the matrix only one triangle is kept.
    bool needs(Index i, Index k) const { return k >= i || known_.position[k]; }

    // Adds the residual of Eq 2.6 at `a` to the row of vertex `i` with coefficient `f` in it.
    void add_laplacian_term(Index i, Index a, double f, RowAccumulator<double>& row,
                            RowAccumulator<Vec3>& gradient_row) const {
        f *= laplacian_.weight[a];
        if (needs(i, a)) row.add(a, f * residual_self(a));
        for (Index e = rings_.begin[a]; e < rings_.begin[a + 1]; ++e) {
            const Index k = rings_.neighbor[e];
            if (needs(i, k)) row.add(k, f * residual_neighbor(a, e));
        }
        if (known_.gradient[a]) gradient_row.add(a, -f * delta_[a]);
    }

    // Adds the part of Eq 2.7 through M_a to the row of vertex `i` with coefficient `g` in M_a.
    void add_coherence_term(Index i, Index a, const Vec3& g, RowAccumulator<double>& row,
                            RowAccumulator<Vec3>& gradient_row) const {
        const Vec3 scaled = options_.coherence_weight * g;
        const Index grain = assembly_grain(rings_.size()), n = a % grain;
        const CoherenceRows& rows = coherence_[a / grain];
        for (Index e = rows.begin[n]; e < rows.begin[n + 1]; ++e) {
            const Index k = rows.column[e];
            if (needs(i, k)) row.add(k, scaled.dot(rows.value[e]));
        }
        for (Index e = rows.known_begin[n]; e < rows.known_begin[n + 1]; ++e) {
            gradient_row.add(rows.known_column[e], rows.known_value[e] * scaled);
        }
    }

    SystemRows system_rows(const std::vector<Index>& free, Index begin, Index end,
                           const Context& context) const {
        SystemRows rows;
        RowAccumulator<double> row(rings_.size());
        RowAccumulator<Vec3> gradient_row(rings_.size());
        const auto add_terms = [&](Index a, Index i) {
            const Index entry = a == i ? kNoIndex : rings_.entry(a, i);
            if (has_row(a)) {
                const double f = a == i ? residual_self(a) : residual_neighbor(a, entry);
                add_laplacian_term(i, a, f, row, gradient_row);
            }
            // There are no such rows of vertices whose gradient is known or not defined.
            const Vec3& g = a == i ? gradients_.self[a] : gradients_.neighbor[entry];
            add_coherence_term(i, a, g, row, gradient_row);
        };
        for (Index r = begin; r < end; ++r) {
            context.checkpoint();
            const Index i = free[r];
            row.add(i, is_idle(i) ? 1.0 : 0.0);
            add_terms(i, i);
            for (const Index a : rings_.ring(i)) add_terms(a, i);
            emit(row, gradient_row, rows);
        }
        return rows;
    }

    void emit(RowAccumulator<double>& row, RowAccumulator<Vec3>& gradient_row,
              SystemRows& rows) const {
        row.drain([&](Index k, double value) {
            if (known_.position[k]) {
                rows.position_column.push_back(k);
                rows.position_value.push_back(value);
            } else {
                rows.matrix_column.push_back(row_of_[k]);
                rows.matrix_value.push_back(value);
            }
        });
        gradient_row.drain([&](Index k, const Vec3& value) {
            rows.gradient_column.push_back(k);
            rows.gradient_value.push_back(value);
        });
        rows.matrix_begin.push_back(count_of(rows.matrix_column));
        rows.position_begin.push_back(count_of(rows.position_column));
        rows.gradient_begin.push_back(count_of(rows.gradient_column));
    }

    const WorkingPatch& work_;
    const Rings& rings_;
    const RingGeometry& geometry_;
    const Laplacian& laplacian_;
    const GradientStencils& gradients_;
    const KnownMask& known_;
    const DeformOptions& options_;
    std::vector<Vec3> delta_;
    std::vector<Index> row_of_;
    std::multimap<Index, const GradientTie*> ties_of_;
    std::vector<CoherenceRows> coherence_;
};

// Whether a vertex has other stencils than before, or other values are known there.
std::vector<char> changed_vertices(const Rings& rings, const GradientStencils& gradients,
                                   const KnownMask& known, const FormerAssembly& former) {
    const GradientStencils& before = *former.gradients;
    std::vector<char> changed(at(rings.size()));
    for (Index i = 0; i < rings.size(); ++i) {
        const std::size_t v = at(i);
        bool same = known.position[v] == former.known->position[v] &&
                    known.gradient[v] == former.known->gradient[v] &&
                    gradients.defined[v] == before.defined[v] &&
                    gradients.self[v] == before.self[v] &&
                    gradients.displaced_rest[v] == before.displaced_rest[v];
        for (Index e = rings.begin[v]; same && e < rings.begin[v + 1]; ++e) {
            same = gradients.neighbor[at(e)] == before.neighbor[at(e)];
        }
        changed[v] = !same;
    }
    return changed;
}

// The vertices within `reach` rings of marked ones.
std::vector<char> within(const Rings& rings, std::vector<char> marked, Index reach) {
    std::vector<Index> front, next;
    for (Index i = 0; i < rings.size(); ++i) {
        if (marked[at(i)]) front.push_back(i);
    }
    for (Index ring = 0; ring < reach; ++ring) {
        next.clear();
        for (const Index i : front) {
            for (const Index j : rings.ring(i)) {
                if (!std::exchange(marked[at(j)], 1)) next.push_back(j);
            }
        }
        front.swap(next);
    }
    return marked;
}

// Appends row n of compressed rows `from_*` to others.
template <typename Value>
void append_row(std::vector<Index>& begin, std::vector<Index>& column, std::vector<Value>& value,
                const std::vector<Index>& from_begin, const std::vector<Index>& from_column,
                const std::vector<Value>& from_value, Index n) {
    const auto first = from_begin[at(n)], last = from_begin[at(n) + 1];
    column.insert(column.end(), from_column.begin() + first, from_column.begin() + last);
    value.insert(value.end(), from_value.begin() + first, from_value.begin() + last);
    begin.push_back(count_of(column));
}

// Entries below this share of the mean of their diagonal entries are rounding.
constexpr double kRounding = 1e-13;

// The stencils for unknowns y of which those of normal points are x_p - x_v.
GradientStencils relative_stencils(const WorkingPatch& work, const GradientStencils& gradients,
                                   const std::vector<Index>& relative) {
    GradientStencils result = gradients;
    for (const Index v : relative) {
        result.self[at(v)] += result.neighbor[at(work.rings.begin[at(v) + 1] - 1)];
    }
    return result;
}

// Flat vertices that are free, as is the point beside them, which M_v depends on.
std::vector<Index> relative_vertices(const WorkingPatch& work, const GradientStencils& gradients,
                                     const KnownMask& known) {
    std::vector<Index> vertices;
    for (std::size_t k = 0; k < work.patch.normal_points.size(); ++k) {
        const Index v = work.patch.normal_points[k];
        const Index point = work.patch.first_normal_point() + index_of(k);
        if (!gradients.defined[at(v)] || known.gradient[at(v)]) continue;
        if (!known.position[at(v)] && !known.position[at(point)]) vertices.push_back(v);
    }
    return vertices;
}

// Entries between positions within a plane and points off it cancel but for their rounding. The
// diagonal is the first entry of each column.
void drop_rounding(SymmetricMatrix& matrix) {
    std::vector<double> diagonal(at(matrix.size()));
    for (Index i = 0; i < matrix.size(); ++i)
        diagonal[at(i)] = matrix.value[at(matrix.begin[at(i)])];
    std::size_t kept = 0;
    Index begin = 0;
    for (Index i = 0; i < matrix.size(); ++i) {
        const Index end = matrix.begin[at(i) + 1];
        for (Index e = begin; e < end; ++e) {
            const Index k = matrix.row[at(e)];
            const double value = matrix.value[at(e)];
            const double unit = diagonal[at(i)] * diagonal[at(k)];
            if (k != i && !(value * value > kRounding * kRounding * unit)) continue;
            matrix.row[kept] = k;
            matrix.value[kept++] = value;
        }
        begin = end;
        matrix.begin[at(i) + 1] = index_of(kept);
    }
    matrix.row.resize(kept);
    matrix.value.resize(kept);
}

// Final position of `v` as a sum of solved positions: displaced vertices come back by v = M (v -
// v') + v' (section 2.4.3).
SparseRow final_position(const WorkingPatch& work, const GradientStencils& g, Index v) {
    SparseRow row{{v, 1.0}};
    const Vec3 back = work.patch.rest[v] - g.displaced_rest[v];
    if (!g.defined[v] || back.isZero(0.0)) return row;
    row.front().second += g.self[v].dot(back);
    for (Index e = work.rings.begin[v]; e < work.rings.begin[v + 1]; ++e) {
        row.emplace_back(work.rings.neighbor[e], g.neighbor[e].dot(back));
    }
    return row;
}

}  // namespace

GradientSystem::GradientSystem(const WorkingPatch& work, const GradientStencils& gradients,
                               const KnownMask& known, const DeformOptions& options,
                               const Context& context, const FormerAssembly& former)
    // Gradients around two vertices of a pair depend on the rings of both.
    : order_(RegionOrder::of(work, work.rings, work.patch.surface_count, options.coherence + 2)) {
    const bool copies = former.system && former.system->is_as_assembled();
    // Rounding is told by the diagonals of other rows.
    const Index reach = (options.coherence + 2) * (work.patch.normal_points.empty() ? 1 : 2);
    const std::vector<char> changed =
        copies ? within(work.rings, changed_vertices(work.rings, gradients, known, former), reach)
               : std::vector<char>(at(work.rings.size()), 1);
    const GradientSystem* const from = copies ? former.system : nullptr;
    const std::vector<Index> relative = relative_vertices(work, gradients, known);
    if (relative.empty()) {
        assemble(work, gradients, known, options, context, changed, from);
        return;
    }
    const std::vector<Index> row_of = assemble(work, relative_stencils(work, gradients, relative),
                                               known, options, context, changed, from);
    for (const Index v : relative) {
        relative_.emplace_back(row_of[at(work.rings.ring(v).back())], row_of[at(v)]);
    }
}

// Rows of changed vertices come from `parts`, one after the other, and others from `former`.
void GradientSystem::join_rows(const std::vector<char>& changed, const std::vector<Index>& row_of,
                               const std::vector<SystemRows>& parts, const GradientSystem* former) {
    std::vector<Index> former_row(row_of.size(), kNoIndex);
    if (former) {
        for (std::size_t r = 0; r < former->free_.size(); ++r) {
            former_row[at(former->free_[r])] = index_of(r);
        }
    }
    std::size_t part = 0;
    Index n = 0;
    for (const Index v : free_) {
        if (!changed[at(v)]) {
            copy_row(*former, former_row[at(v)], row_of);
            continue;
        }
        if (n + 1 == count_of(parts[part].matrix_begin)) {
            ++part;
            n = 0;
        }
        const SystemRows& from = parts[part];
        append_row(matrix_.begin, matrix_.row, matrix_.value, from.matrix_begin, from.matrix_column,
                   from.matrix_value, n);
        append_row(positions_.begin, positions_.column, positions_.value, from.position_begin,
                   from.position_column, from.position_value, n);
        append_row(gradients_begin_, gradients_column_, gradients_value_, from.gradient_begin,
                   from.gradient_column, from.gradient_value, n);
        ++n;
    }
}

void GradientSystem::copy_row(const GradientSystem& former, Index r,
                              const std::vector<Index>& row_of) {
    const auto first = matrix_.row.size();
    append_row(matrix_.begin, matrix_.row, matrix_.value, former.matrix_.begin, former.matrix_.row,
               former.matrix_.value, r);
    for (std::size_t e = first; e < matrix_.row.size(); ++e) {
        matrix_.row[e] = row_of[at(former.free_[at(matrix_.row[e])])];
    }
    append_row(positions_.begin, positions_.column, positions_.value, former.positions_.begin,
               former.positions_.column, former.positions_.value, r);
    append_row(gradients_begin_, gradients_column_, gradients_value_, former.gradients_begin_,
               former.gradients_column_, former.gradients_value_, r);
}

std::vector<Index> GradientSystem::assemble(const WorkingPatch& work,
                                            const GradientStencils& gradients,
                                            const KnownMask& known, const DeformOptions& options,
                                            const Context& context,
                                            const std::vector<char>& changed,
                                            const GradientSystem* former) {
    Assembler assembler(work, gradients, known, options);
    free_ = assembler.number_free_vertices();
    std::vector<Index> rows;
    for (const Index v : free_) {
        if (changed[at(v)]) rows.push_back(v);
    }
    assembled_rows_ = count_of(rows);
    assembler.build_coherence(within(work.rings, changed, 1), context);
    positions_.columns = work.patch.vertex_count;
    const std::vector<SystemRows> parts = assembler.build_rows(rows, context);
    std::size_t entries = former ? former->matrix_.row.size() : 0;
    for (const SystemRows& part : parts) entries += part.matrix_column.size();
    matrix_.row.reserve(entries);
    matrix_.value.reserve(entries);
    prefer_large_pages(matrix_.row);
    prefer_large_pages(matrix_.value);
    join_rows(changed, assembler.row_of(), parts, former);
    if (!work.patch.normal_points.empty()) drop_rounding(matrix_);
    ties_ = TieRows(work.ties, assembler.row_of(), work.position_unit(),
                    [&](Index v) { return final_position(work, gradients, v); });
    ties_.add_to(matrix_);
    tie_bytes_ = TieRows::response_bytes(work.ties, count_of(free_));
    return assembler.row_of();
}

void GradientSystem::factor(const Context& context, OrderedSystem former) {
    system_ = std::move(former);
    is_firm_ = system_.factor(matrix_, free_, std::exchange(order_, {}), context);
    ties_charge_ = context.charge(tie_bytes_, "points that are held");
    ties_.prepare(count_of(free_),
                  [&](std::span<const double> b, std::span<double> x, Index columns) {
                      const std::vector<Extended> exact(b.begin(), b.end());
                      system_.system().solve_refined(matrix_, exact, x, columns);
                  });
}

}  // namespace lissom
