#include "kernel/deform/boundary/boundary_solution.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/core/extended.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/system/frame_blocks.h"

namespace lissom {
namespace {

// Corrections of the first system by the residual of its energy.
constexpr int kCorrections = 2;

// Rotation that fits the held vertices best: of their places about the center, and a little of
// their own.
Mat3 base_rotation(const BoundarySystems& from, std::span<const BoundaryValue> values,
                   const BoundaryBase& base) {
    Mat3 products = Mat3::Zero();
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Vec3 rest = from.rest(from.held_local[i]);
        products += (values[i].position - base.center) / base.length * rest.transpose();
        products += 1e-3 * values[i].rotation;
    }
    return nearest_rotation(products);
}

BoundaryBase base_of(const BoundarySystems& from, std::span<const BoundaryValue> values) {
    if (from.surrounded) return {Mat3::Identity(), 1.0, from.frame.center, from.frame.unit};
    BoundaryBase base;
    Vec3 sum = Vec3::Zero();
    double logs = 0.0;
    for (const BoundaryValue& value : values) {
        sum += value.position - values.front().position;
        logs += std::log(value.scale);
    }
    const double count = values.size();
    base.center = values.front().position + sum / count;
    base.scale = std::exp(logs / count);
    base.length = base.scale * from.frame.unit;
    base.rotation = base_rotation(from, values, base);
    return base;
}

// Removes rounding errors of the matrix of the first system.
void correct_first(const BoundarySystems& from, BoundarySolution& now) {
    const std::vector<Index>& free = from.first->free_vertices();
    const std::size_t rows = free.size();
    const std::vector<Vec3> left = from.residual->find(now.deviation, now.known_turn);
    std::vector<double> columns(rows * 3);
    for (std::size_t r = 0; r < rows; ++r) {
        for (std::size_t d = 0; d < 3; ++d) columns[d * rows + r] = left[free[r]][d];
    }
    from.first->solve_roughly(columns, columns, 3);
    for (std::size_t r = 0; r < rows; ++r) {
        now.deviation[free[r]] += Vec3(columns[r], columns[rows + r], columns[2 * rows + r]);
    }
}

// For deviations from the base: the system is linear.
void solve_free(const BoundarySystems& from, BoundarySolution& now) {
    const std::vector<Index>& free = from.first->free_vertices();
    const std::size_t rows = free.size();
    std::vector<Extended> right(rows * 3);
    for (int d = 0; d < 3; ++d) {
        from.first->right_hand_side([&](Index k) { return now.deviation[k][d]; },
                                    [&](Index k) { return Vec3(now.known_turn[k].row(d)); },
                                    right.data() + d * rows);
    }
    const std::vector<double> columns = from.first->solve(right, 3);
    for (std::size_t r = 0; r < rows; ++r) {
        now.deviation[free[r]] = {columns[r], columns[rows + r], columns[2 * rows + r]};
    }
    const bool corrects = from.options.coherence == 1 && from.options.scale_free;
    for (int step = 0; corrects && step < kCorrections; ++step) correct_first(from, now);
}

// Rotation and scale of the features in the second system, from M_i of the first.
void turn_features(const BoundarySystems& from, BoundarySolution& now) {
    for (Index f = 0; f < from.common->size(); ++f) {
        const Index one = from.common->vertices(f).front();
        const Mat3 m = now.base.rotation + now.known_turn[one];
        if (from.size_field == SizeField::gradient) now.size[one] = uniform_scale(m);
        const Mat3 turn = now.size[one] * nearest_rotation(m) - now.base.rotation;
        for (const Index v : from.common->vertices(f)) {
            now.deviation[v] += (turn - now.known_turn[v]) * from.common->arm(v);
            now.size[v] = now.size[one];
        }
        for (const Index v : from.common->vertices(f)) now.known_turn[v] = turn;
    }
}

bool has_gradient(const BoundarySystems& from, Index v) {
    return from.known.gradient[v] || from.stencils.defined[v];
}

// M_i after the first system, if it exists.
Mat3 gathered(const BoundarySystems& from, const BoundarySolution& now, Index v) {
    return from.known.gradient[v]
               ? Mat3(now.base.rotation + now.known_turn[v])
               : Mat3(now.base.rotation + from.stencils.gather(from.work.rings, now.deviation, v));
}

// The mean M_i of the ring of a vertex that has none itself.
Mat3 gathered_around(const BoundarySystems& from, const BoundarySolution& now, Index v) {
    Mat3 sum = Mat3::Zero();
    int count = 0;
    for (const Index n : from.work.rings.ring(v)) {
        if (!has_gradient(from, n)) continue;
        sum += gathered(from, now, n);
        ++count;
    }
    return count > 0 ? Mat3(sum / count) : now.base.rotation;
}

std::vector<Mat3> gradients_of(const BoundarySystems& from, const BoundarySolution& now,
                               const Context& context) {
    std::vector<Mat3> m(from.work.patch.real_count, now.base.rotation);
    for_each_block(context, from.work.patch.real_count, [&](Index begin, Index end) {
        for (Index v = begin; v < end; ++v) {
            m[v] = has_gradient(from, v) ? gathered(from, now, v) : gathered_around(from, now, v);
        }
    });
    return m;
}

// Mean position that the edges at a held vertex ask for, less its present one.
Vec3 pull_at(const BoundarySystems& from, const EnergyLoop& loop, const BoundarySolution& now,
             Index v) {
    const auto transform = [&](Index u) {
        return Mat3(now.base.rotation + now.turns[u].topRows<3>());
    };
    Vec3 sum = Vec3::Zero();
    double weight = 0.0;
    for (Index e = loop.ring_begin[v]; e < loop.ring_begin[v + 1]; ++e) {
        const Index u = loop.neighbor[e];
        const Vec3 edge = from.work.patch.rest[v] - from.work.patch.rest[u];
        const Vec3 is = now.base.rotation * edge + now.deviation[v] - now.deviation[u];
        const Vec3 would = 0.5 * (transform(v) + transform(u)) * edge;
        sum += loop.edge_weight[e] * (would - is);
        weight += loop.edge_weight[e];
    }
    return weight > 0.0 ? Vec3(now.base.length / weight * sum) : Vec3(Vec3::Zero());
}

// Held vertices have their values to the bit. Those with slack have turned on in a refinement.
void put_held(const BoundarySystems& from, const BoundarySolution& now, BoundaryDeformation& out) {
    const std::vector<Index>& ids = from.region.vertices();
    for (std::size_t i = 0; i < now.values.size(); ++i) {
        const Index v = from.held.vertices()[i];
        const auto row = std::lower_bound(ids.begin(), ids.end(), v) - ids.begin();
        const BoundaryValue& value = now.values[i];
        out.positions[row] = value.position;
        if (!(value.slack > 0.0)) out.transforms[row] = value.scale * value.rotation;
    }
}

}  // namespace

BoundarySolution placed(const BoundarySystems& from, std::span<const BoundaryValue> values) {
    BoundarySolution now;
    now.values.assign(values.begin(), values.end());
    now.base = base_of(from, values);
    const std::size_t n = from.work.patch.vertex_count;
    now.deviation.assign(n, Vec3::Zero());
    now.known_turn.assign(n, Mat3::Zero());
    now.size.assign(n, 1.0 / now.base.scale);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Index v = from.held_local[i];
        now.deviation[v] = (values[i].position - now.base.center) / now.base.length -
                           now.base.rotation * from.rest(v);
        now.size[v] = values[i].scale / now.base.scale;
        now.known_turn[v] = now.size[v] * values[i].rotation - now.base.rotation;
    }
    return now;
}

BoundarySolution first_solved(const BoundarySystems& from, BoundarySolution now) {
    if (from.has_free()) solve_free(from, now);
    from.common->release_first(now.deviation, now.known_turn);
    return now;
}

// S_i of the second system less the base's: rotations without shear, times the size.
BoundarySolution turned(const BoundarySystems& from, BoundarySizes& sizes, BoundarySolution now,
                        const Context& context) {
    const bool by_gradient = from.size_field == SizeField::gradient;
    if (!by_gradient) now.size = sizes.interpolated(from, std::move(now.size), context);
    turn_features(from, now);
    std::vector<Mat3> m = gradients_of(from, now, context);
    for (Index v = 0; by_gradient && v < from.work.patch.real_count; ++v) {
        if (!from.known.gradient[v]) now.size[v] = uniform_scale(m[v]);
    }
    nearest_rotations(m, m);
    now.turns.resize(m.size());
    for (std::size_t v = 0; v < m.size(); ++v) {
        now.turns[v] = from.known.gradient[v]
                           ? padded_columns(now.known_turn[v])
                           : padded_columns(now.size[v] * m[v] - now.base.rotation);
    }
    return now;
}

BoundarySolution second_solved(const BoundarySystems& from, BoundarySolution now,
                               const Context& context) {
    std::vector<Vec4> x;
    for (const Vec3& d : now.deviation) x.push_back(padded(d));
    if (from.has_free()) from.second->solve(now.turns, x, false, context);
    from.common->release_second(now.turns, x, context);
    for (std::size_t v = 0; v < x.size(); ++v) now.deviation[v] = x[v].head<3>();
    return now;
}

BoundaryDeformation deformation_of(const BoundarySystems& from, const BoundarySolution& now) {
    BoundaryDeformation out;
    const BoundaryBase& base = now.base;
    for (const Index v : from.work.patch.of_region) {
        const Vec3 at = base.rotation * from.rest(v) + now.deviation[v];
        out.positions.push_back(base.center + base.length * at);
        out.transforms.push_back(base.scale * (base.rotation + now.turns[v].topRows<3>()));
    }
    put_held(from, now, out);
    const EnergyLoop loop = from.second->energy();
    for (const Index v : from.held_local) out.pulls.push_back(pull_at(from, loop, now, v));
    return out;
}

}  // namespace lissom
