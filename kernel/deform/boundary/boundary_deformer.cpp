#include "kernel/deform/boundary/boundary_deformer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kernel/core/clock.h"
#include "kernel/core/extended.h"
#include "kernel/deform/boundary/common_gradients.h"
#include "kernel/deform/boundary/rigid_fit.h"
#include "kernel/deform/holds/constraints.h"
#include "kernel/deform/patch/working_patch.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/system/frame_blocks.h"
#include "kernel/deform/system/gradient_residual.h"
#include "kernel/deform/system/gradient_system.h"
#include "kernel/deform/system/gradients.h"
#include "kernel/deform/system/rotation_system.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {
namespace {

// Rings around the region that the stencils of its vertices reach.
constexpr Index kRings = 1;
// Corrections of the first system by the residual of its energy.
constexpr int kCorrections = 2;
// Scales that differ by less are one scale.
constexpr double kSameScale = 1e-12;
// Lower bound of the weights of the harmonic interpolation, so that it never leaves the range of
// the interpolated values.
constexpr double kMinWeight = 1e-3;
// How far beyond the rotations that fit best a step of a refinement goes, in parts of the way to
// them; smaller parts than the least count as none. A step that gains less is the last.
constexpr double kMaxFurther = 1.6, kMinFurther = 0.3, kMinGain = 1e-4;

DeformOptions deform_options(const BoundaryDeformOptions& options) {
    DeformOptions result;
    result.second = options.second;
    result.local_size = LocalSize::scale;
    result.weights = options.weights;
    result.coherence = options.coherence;
    result.coherence_weight = options.coherence_weight;
    result.degenerate_threshold = options.degenerate_threshold;
    result.displacement = options.displacement;
    result.scale_free = options.scale_free;
    result.subdivide_borders = false;
    result.flat = FlatVertices::displaced;
    return result;
}

// The rest shape centred on the mean of the held vertices, in units of the RMS distance to it.
struct Normalization {
    Vec3 center = Vec3::Zero();
    double unit = 1.0;

    Normalization(const Mesh& mesh, const Region& region, const Region& held) {
        const Vec3 first = mesh.position(held.vertices().front());
        Vec3 sum = Vec3::Zero();
        for (const Index v : held.vertices()) sum += mesh.position(v) - first;
        center = first + sum / held.size();
        double squares = 0.0;
        for (const Index v : region.vertices()) {
            squares += (mesh.position(v) - center).squaredNorm();
        }
        if (squares > 0.0) unit = std::sqrt(squares / region.size());
    }

    std::vector<Vec3> apply(std::span<const Vec3> positions) const {
        std::vector<Vec3> result;
        result.reserve(positions.size());
        for (const Vec3& p : positions) result.push_back((p - center) / unit);
        return result;
    }
};

// The similarity that a solution deviates from: rest position q, normalised, goes to
// center + length * (rotation q + deviation).
struct Base {
    Mat3 rotation = Mat3::Identity();
    double scale = 1.0;
    Vec3 center = Vec3::Zero();
    double length = 1.0;
};

void require_values(std::span<const BoundaryValue> values, Index count) {
    if (count_of(values) != count) {
        throw Error(ErrorCode::invalid_argument,
                    "give one value for each held vertex: " + std::to_string(count));
    }
    for (const BoundaryValue& value : values) {
        if (!value.position.allFinite() || !value.rotation.allFinite()) {
            throw Error(ErrorCode::not_finite, "values of held vertices must be finite");
        }
        if (!(value.slack >= 0.0) || !value.upright.allFinite()) {
            throw Error(ErrorCode::invalid_argument,
                        "the slack of a held vertex must be 0 or more");
        }
        if (!(value.scale > 0.0) || !std::isfinite(value.scale)) {
            throw Error(ErrorCode::invalid_argument, "scales of held vertices must be above 0");
        }
    }
}

void require_none(const Region& wrong, ErrorCode code, const char* why) {
    if (wrong.empty()) return;
    Elements vertices{ElementKind::vertex, 0, {}};
    for (const Index v : wrong.vertices()) vertices.add(v);
    throw Error(code, describe(vertices) + why, vertices);
}

void require_inside(const Region& region, const Region& held) {
    if (held.empty()) throw Error(ErrorCode::region_empty, "hold at least one vertex");
    require_none(held.minus(region), ErrorCode::handle_outside_region,
                 " cannot be held: they lie outside the region");
}

void require_features(const Region& region, const Region& held,
                      const std::vector<Region>& features) {
    Region taken = held;
    for (const Region& feature : features) {
        require_none(feature.minus(region), ErrorCode::handle_outside_region,
                     " cannot be of a feature: they lie outside the region");
        require_none(feature.intersected(taken), ErrorCode::handle_overlap,
                     " cannot be of a feature: they are held, or of another");
        taken = taken.united(feature);
    }
}

}  // namespace

BoundaryDeformOptions BoundaryDeformOptions::thesis() {
    BoundaryDeformOptions options;
    const DeformOptions literal = DeformOptions::thesis();
    options.size = SizeField::gradient;
    options.second = literal.second;
    options.coherence = literal.coherence;
    options.degenerate_threshold = literal.degenerate_threshold;
    options.scale_free = literal.scale_free;
    return options;
}

struct BoundaryDeformer::State {
    State(const Mesh& mesh, const Region& given, const Region& fixed,
          const BoundaryDeformOptions& chosen, const Context& context);

    void find_knowledge();
    void know_features();
    Index local_vertex(Index v) const;
    std::vector<std::vector<Index>> local_features() const;
    void require_area() const;
    void factor(const Context& context);
    template <typename System>
    void factor(System& system, const Context& context) const;

    Base find_base() const;
    void place_held();
    void solve_first();
    void correct_first();
    Mat3 gathered(Index v) const;
    std::vector<Mat3> gradients(const Context& context) const;
    void find_sizes(const Context& context);
    void turn_features();
    double harmonic_weight(Index entry) const;
    void factor_sizes(const Context& context);
    void interpolate_sizes(const Context& context);
    template <typename Use>
    void for_each_harmonic_entry(const Use& use) const;
    void find_turns(const Context& context);
    void solve_second(const Context& context);
    FittedTurns fitted(const Context& context) const;
    bool step(FittedTurns& now, double& further, const Context& context);
    std::vector<double> refine(int steps, const Context& context);
    std::vector<Vec3> pulls() const;
    BoundaryDeformation result() const;

    Region region, held;
    BoundaryDeformOptions asked;
    DeformOptions options;
    Normalization normal_form;
    WorkingPatch work;
    /// Local vertices of `held`, in its order, and whether anything else is fixed.
    std::vector<Index> held_local;
    bool surrounded = false;
    KnownMask known;
    GradientStencils stencils;
    std::unique_ptr<GradientSystem> first;
    std::unique_ptr<RotationSystem> second;
    std::unique_ptr<GradientResidual> residual;
    std::unique_ptr<CommonGradients> common;
    /// Harmonic interpolation over the vertices that are not held, made when scales first differ.
    std::unique_ptr<SparseSystem> harmonic;
    std::vector<Index> harmonic_row;
    Index harmonic_rows = 0;
    DeformStats stats;

    /// State of the present solve: values, rotation limits of vertices, and the base.
    std::vector<BoundaryValue> values;
    std::vector<TurnLimit> limits;
    Base base;
    /// Relative to the base: deviations of positions and of known gradients,
    /// scales, and transforms of the second system.
    std::vector<Vec3> deviation;
    std::vector<Mat3> known_turn;
    std::vector<double> size;
    std::vector<PaddedMat3> turns;
};

BoundaryDeformer::State::State(const Mesh& mesh, const Region& given, const Region& fixed,
                               const BoundaryDeformOptions& chosen, const Context& context)
    : region(given),
      held(fixed),
      asked(chosen),
      options(deform_options(chosen)),
      normal_form(mesh, given, fixed),
      work(build_patch(given, normal_form.apply(mesh.positions()), kRings,
                       near_order(given, kRings)),
           options) {
    Progress progress(context, "deform: prepare");
    require_area();
    find_knowledge();
    require_constraints(work, known);
    know_features();
    progress.step(0.3);
    const auto start = Clock::now();
    const Patch& patch = work.patch;
    stencils = make_gradients(patch, work.rings, work.geometry, known, -patch.origin, options);
    first = std::make_unique<GradientSystem>(work, stencils, known, options, context);
    second = std::make_unique<RotationSystem>(work, known.position, options, context);
    residual = std::make_unique<GradientResidual>(work, stencils, known, options);
    common = std::make_unique<CommonGradients>(work, local_features(), *first, *residual, *second);
    stats.assemble_seconds = seconds_since(start);
    progress.step(0.7);
    factor(context);
    common->prepare(context);
}

// Vertices outside the region and without faces stay; held ones take their values.
void BoundaryDeformer::State::find_knowledge() {
    const Patch& patch = work.patch;
    const std::size_t n = patch.vertex_count;
    known = {std::vector<char>(n, 0), std::vector<char>(n, 0), std::vector<char>(n, 0)};
    for (Index i = 0; i < patch.surface_count; ++i) {
        const bool lonely = work.rings.count(i) == 0;
        if (patch.in_region[i] && !lonely) continue;
        known.position[i] = known.gradient[i] = 1;
        surrounded = surrounded || !lonely;
    }
    for (const Index v : held.vertices()) held_local.push_back(local_vertex(v));
    for (const Index v : held_local) known.position[v] = known.gradient[v] = 1;
    for (Index i = 0; i < patch.surface_count; ++i) {
        known.gradient_wanted[i] = !known.gradient[i] && work.rings.count(i) > 0;
    }
}

// Marks features as known to the systems; their values are found afterwards.
void BoundaryDeformer::State::know_features() {
    for (const std::vector<Index>& feature : local_features()) {
        for (const Index v : feature) {
            known.position[v] = known.gradient[v] = 1;
            known.gradient_wanted[v] = 0;
        }
    }
}

Index BoundaryDeformer::State::local_vertex(Index v) const {
    const std::vector<Index>& ids = region.vertices();
    return work.patch.of_region[std::lower_bound(ids.begin(), ids.end(), v) - ids.begin()];
}

std::vector<std::vector<Index>> BoundaryDeformer::State::local_features() const {
    std::vector<std::vector<Index>> result;
    for (const Region& feature : asked.features) {
        if (feature.empty()) continue;
        result.emplace_back();
        for (const Index v : feature.vertices()) result.back().push_back(local_vertex(v));
    }
    return result;
}

void BoundaryDeformer::State::require_area() const {
    const Elements& vertices = work.patch.zero_area_vertices;
    if (vertices.count == 0) return;
    throw Error(
        ErrorCode::zero_area,
        "all faces around " + describe(vertices) + " have no area; collapse those faces first",
        vertices);
}

template <typename System>
void BoundaryDeformer::State::factor(System& system, const Context& context) const {
    if (!system.free_vertices().empty()) system.factor(context);
}

void BoundaryDeformer::State::factor(const Context& context) {
    // The two do not depend on each other.
    context.parallel_for(0, 2, 1, [&](Index begin, Index end) {
        for (Index system = begin; system < end; ++system) {
            system == 0 ? factor(*first, context) : factor(*second, context);
        }
    });
    if (!second->free_vertices().empty()) second->finish(context);
    const FactorStats &a = first->stats(), &b = second->stats();
    stats.region_vertices = region.size();
    stats.constrained_vertices = held.size();
    stats.free_vertices = count_of(second->free_vertices());
    stats.displaced_vertices = count_of(stencils.displaced);
    stats.zero_area_faces = work.patch.zero_area_faces;
    stats.first_nonzeros = a.factor_nonzeros;
    stats.second_nonzeros = b.factor_nonzeros;
    stats.factor_bytes = a.factor_bytes + b.factor_bytes;
    stats.first_factor_seconds = a.analyze_seconds + a.factor_seconds;
    stats.second_factor_seconds = b.analyze_seconds + b.factor_seconds;
    stats.factorizations = 1;
}

// Returns the similarity that fits the values if nothing else is fixed; else the identity.
Base BoundaryDeformer::State::find_base() const {
    if (surrounded) return {Mat3::Identity(), 1.0, normal_form.center, normal_form.unit};
    Base found;
    Vec3 sum = Vec3::Zero();
    double logs = 0.0;
    for (const BoundaryValue& value : values) {
        sum += value.position - values.front().position;
        logs += std::log(value.scale);
    }
    const double count = values.size();
    found.center = values.front().position + sum / count;
    found.scale = std::exp(logs / count);
    found.length = found.scale * normal_form.unit;
    Mat3 products = Mat3::Zero();
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Vec3 from = work.patch.rest[held_local[i]] + work.patch.origin;
        products += (values[i].position - found.center) / found.length * from.transpose();
        products += 1e-3 * values[i].rotation;
    }
    found.rotation = nearest_rotation(products);
    return found;
}

void BoundaryDeformer::State::place_held() {
    const std::size_t n = work.patch.vertex_count;
    deviation.assign(n, Vec3::Zero());
    known_turn.assign(n, Mat3::Zero());
    size.assign(n, 1.0 / base.scale);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Index v = held_local[i];
        const Vec3 from = work.patch.rest[v] + work.patch.origin;
        deviation[v] = (values[i].position - base.center) / base.length - base.rotation * from;
        size[v] = values[i].scale / base.scale;
        known_turn[v] = size[v] * values[i].rotation - base.rotation;
    }
}

// Solves Eq 2.8 for deviations from the base: it is linear.
void BoundaryDeformer::State::solve_first() {
    const std::vector<Index>& free = first->free_vertices();
    const std::size_t rows = free.size();
    std::vector<Extended> right(rows * 3);
    for (int d = 0; d < 3; ++d) {
        first->right_hand_side([&](Index k) { return deviation[k][d]; },
                               [&](Index k) { return Vec3(known_turn[k].row(d)); },
                               right.data() + d * rows);
    }
    const std::vector<double> columns = first->solve(right, 3);
    for (std::size_t r = 0; r < rows; ++r) {
        deviation[free[r]] = {columns[r], columns[rows + r], columns[2 * rows + r]};
    }
    const bool corrects = options.coherence == 1 && options.scale_free;
    for (int step = 0; corrects && step < kCorrections; ++step) correct_first();
}

// Removes rounding errors of the matrix.
void BoundaryDeformer::State::correct_first() {
    const std::vector<Index>& free = first->free_vertices();
    const std::size_t rows = free.size();
    const std::vector<Vec3> left = residual->find(deviation, known_turn);
    std::vector<double> columns(rows * 3);
    for (std::size_t r = 0; r < rows; ++r) {
        for (std::size_t d = 0; d < 3; ++d) columns[d * rows + r] = left[free[r]][d];
    }
    first->solve_roughly(columns, columns, 3);
    for (std::size_t r = 0; r < rows; ++r) {
        deviation[free[r]] += Vec3(columns[r], columns[rows + r], columns[2 * rows + r]);
    }
}

Mat3 BoundaryDeformer::State::gathered(Index v) const {
    return known.gradient[v] ? Mat3(base.rotation + known_turn[v])
                             : Mat3(base.rotation + stencils.gather(work.rings, deviation, v));
}

// Rotation and scale of the features in the second system, from M_i of the first.
void BoundaryDeformer::State::turn_features() {
    for (Index f = 0; f < common->size(); ++f) {
        const Index one = common->vertices(f).front();
        const Mat3 m = base.rotation + known_turn[one];
        if (asked.size == SizeField::gradient) size[one] = uniform_scale(m);
        const Mat3 turn = size[one] * nearest_rotation(m) - base.rotation;
        for (const Index v : common->vertices(f)) {
            deviation[v] += (turn - known_turn[v]) * common->arm(v);
            size[v] = size[one];
        }
        for (const Index v : common->vertices(f)) known_turn[v] = turn;
    }
}

// M_i after the first system; the mean of the ring if it does not exist.
std::vector<Mat3> BoundaryDeformer::State::gradients(const Context& context) const {
    const auto exists = [&](Index v) { return known.gradient[v] || stencils.defined[v]; };
    std::vector<Mat3> m(work.patch.real_count, base.rotation);
    for_each_block(context, work.patch.real_count, [&](Index begin, Index end) {
        for (Index v = begin; v < end; ++v) {
            if (exists(v)) {
                m[v] = gathered(v);
                continue;
            }
            Mat3 sum = Mat3::Zero();
            int count = 0;
            for (const Index n : work.rings.ring(v)) {
                if (!exists(n)) continue;
                sum += gathered(n);
                ++count;
            }
            if (count > 0) m[v] = sum / count;
        }
    });
    return m;
}

// Calls use(row, neighbour, weight) for all neighbours of the vertices with a row in the
// interpolation of sizes; neighbours in the same row do not count for it.
template <typename Use>
void BoundaryDeformer::State::for_each_harmonic_entry(const Use& use) const {
    for (Index v = 0; v < count_of(harmonic_row); ++v) {
        const Index row = harmonic_row[v];
        if (row == kNoIndex) continue;
        for (Index e = work.rings.begin[v]; e < work.rings.begin[v + 1]; ++e) {
            const Index u = work.rings.neighbor[e];
            if (harmonic_row[u] != row) use(row, u, harmonic_weight(e));
        }
    }
}

double BoundaryDeformer::State::harmonic_weight(Index entry) const {
    return std::max(work.geometry.cotangent[entry], kMinWeight);
}

// One row a free vertex, and one a feature.
void BoundaryDeformer::State::factor_sizes(const Context& context) {
    harmonic_row.assign(at(work.patch.surface_count), kNoIndex);
    harmonic_rows = common->size();
    for (Index v = 0; v < work.patch.surface_count; ++v) {
        harmonic_row[v] = common->feature_of(v);
        if (!known.position[v]) harmonic_row[v] = harmonic_rows++;
    }
    std::vector<Triplet> entries;
    for_each_harmonic_entry([&](Index row, Index u, double weight) {
        entries.push_back({row, row, weight});
        const Index other = harmonic_row[u];
        if (other != kNoIndex && other < row) entries.push_back({row, other, -weight});
    });
    const SymmetricMatrix matrix = symmetric_from_triplets(harmonic_rows, entries);
    harmonic = std::make_unique<SparseSystem>();
    harmonic->analyze(matrix, context);
    harmonic->factor(matrix, context);
}

void BoundaryDeformer::State::interpolate_sizes(const Context& context) {
    if (!harmonic) factor_sizes(context);
    std::vector<double> b(at(harmonic_rows), 0.0);
    for_each_harmonic_entry([&](Index row, Index u, double weight) {
        if (harmonic_row[u] == kNoIndex) b[at(row)] += weight * std::log(size[u]);
    });
    harmonic->solve(b, b, 1);
    for (std::size_t v = 0; v < harmonic_row.size(); ++v) {
        if (harmonic_row[v] != kNoIndex) size[v] = std::exp(b[at(harmonic_row[v])]);
    }
}

// Interpolates the sizes of all vertices from the known ones.
void BoundaryDeformer::State::find_sizes(const Context& context) {
    double least = size[held_local.front()], most = least;
    const auto is_given = [&](Index v) {
        return known.position[v] && common->feature_of(v) == kNoIndex && work.rings.count(v) > 0;
    };
    for (Index v = 0; v < work.patch.surface_count; ++v) {
        if (!is_given(v)) continue;
        least = std::min(least, size[v]);
        most = std::max(most, size[v]);
    }
    if (most > least * (1.0 + kSameScale)) {
        if (common->size() > 0 || !second->free_vertices().empty()) interpolate_sizes(context);
        return;
    }
    for (Index v = 0; v < work.patch.surface_count; ++v) {
        if (!known.position[v] || common->feature_of(v) != kNoIndex) size[v] = least;
    }
}

// S_i of the second system less the base's: rotations without shear, times the size.
void BoundaryDeformer::State::find_turns(const Context& context) {
    if (asked.size == SizeField::harmonic) find_sizes(context);
    turn_features();
    std::vector<Mat3> m = gradients(context);
    if (asked.size == SizeField::gradient) {
        for (Index v = 0; v < work.patch.real_count; ++v) {
            if (!known.gradient[v]) size[v] = uniform_scale(m[v]);
        }
    }
    nearest_rotations(m, m);
    turns.resize(m.size());
    for (std::size_t v = 0; v < m.size(); ++v) {
        turns[v] = known.gradient[v] ? padded_columns(known_turn[v])
                                     : padded_columns(size[v] * m[v] - base.rotation);
    }
}

void BoundaryDeformer::State::solve_second(const Context& context) {
    std::vector<Vec4> x;
    for (const Vec3& d : deviation) x.push_back(padded(d));
    if (!second->free_vertices().empty()) second->solve(turns, x, false, context);
    common->release_second(turns, x, context);
    for (std::size_t v = 0; v < x.size(); ++v) deviation[v] = x[v].head<3>();
}

// The rotations that fit the present positions best.
FittedTurns BoundaryDeformer::State::fitted(const Context& context) const {
    std::vector<Vec4> x;
    for (std::size_t v = 0; v < deviation.size(); ++v) {
        x.push_back(padded(Vec3(base.rotation * work.patch.rest[v] + deviation[v])));
    }
    std::vector<Mat3> now;
    for (const PaddedMat3& turn : turns) now.push_back(base.rotation + turn.topRows<3>());
    return fitted_turns(second->energy(), x, now, size, limits, context);
}

// False if no step lowers the energy; then nothing changes. `further` is the last successful step
// length.
bool BoundaryDeformer::State::step(FittedTurns& now, double& further, const Context& context) {
    const std::vector<PaddedMat3> turns_before = turns;
    const std::vector<Vec3> deviation_before = deviation;
    std::vector<Mat3> from;
    for (const PaddedMat3& turn : turns) from.push_back(base.rotation + turn.topRows<3>());
    for (;;) {
        context.checkpoint();
        const std::vector<Mat3> to = turned_beyond(from, now.transform, size, limits, further);
        for (std::size_t v = 0; v < to.size(); ++v) {
            if (limits[v].free) turns[v] = padded_columns(Mat3(to[v] - base.rotation));
        }
        solve_second(context);
        FittedTurns next = fitted(context);
        if (next.energy < (1.0 - kMinGain) * now.energy) {
            now = std::move(next);
            return true;
        }
        turns = turns_before;
        deviation = deviation_before;
        if (further == 0.0) return false;
        further = 0.5 * further < kMinFurther ? 0.0 : 0.5 * further;
    }
}

std::vector<double> BoundaryDeformer::State::refine(int steps, const Context& context) {
    limits.assign(turns.size(), {});
    for (std::size_t v = 0; v < limits.size(); ++v) limits[v].free = known.gradient[v] == 0;
    for (std::size_t i = 0; i < held_local.size(); ++i) {
        limits[at(held_local[i])] = {values[i].slack > 0.0, &values[i]};
    }
    FittedTurns now = fitted(context);
    std::vector<double> energy{now.energy};
    double further = kMaxFurther;
    for (int k = 0; k < steps && step(now, further, context); ++k) energy.push_back(now.energy);
    return energy;
}

// Mean position that the edges at each held vertex ask for, less its present one.
std::vector<Vec3> BoundaryDeformer::State::pulls() const {
    const EnergyLoop loop = second->energy();
    const auto transform = [&](Index v) { return Mat3(base.rotation + turns[v].topRows<3>()); };
    std::vector<Vec3> result;
    for (const Index v : held_local) {
        Vec3 sum = Vec3::Zero();
        double weight = 0.0;
        for (Index e = loop.ring_begin[v]; e < loop.ring_begin[v + 1]; ++e) {
            const Index u = loop.neighbor[e];
            const Vec3 edge = work.patch.rest[v] - work.patch.rest[u];
            const Vec3 is = base.rotation * edge + deviation[v] - deviation[u];
            const Vec3 would = 0.5 * (transform(v) + transform(u)) * edge;
            sum += loop.edge_weight[e] * (would - is);
            weight += loop.edge_weight[e];
        }
        result.push_back(weight > 0.0 ? Vec3(base.length / weight * sum) : Vec3(Vec3::Zero()));
    }
    return result;
}

BoundaryDeformation BoundaryDeformer::State::result() const {
    BoundaryDeformation out;
    const Patch& patch = work.patch;
    for (const Index v : patch.of_region) {
        const Vec3 at = base.rotation * (patch.rest[v] + patch.origin) + deviation[v];
        out.positions.push_back(base.center + base.length * at);
        out.transforms.push_back(base.scale * (base.rotation + turns[v].topRows<3>()));
    }
    const std::vector<Index>& ids = region.vertices();
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto row = std::lower_bound(ids.begin(), ids.end(), held.vertices()[i]) - ids.begin();
        out.positions[row] = values[i].position;
        // Those with slack have turned on in a refinement.
        if (!(values[i].slack > 0.0)) out.transforms[row] = values[i].scale * values[i].rotation;
    }
    out.pulls = pulls();
    return out;
}

BoundaryDeformer::BoundaryDeformer(const Mesh& mesh, const Region& region, const Region& held,
                                   const BoundaryDeformOptions& options, const Context& context) {
    require_same_topology(mesh, region.topology(), "the region");
    require_same_topology(mesh, held.topology(), "the held vertices");
    require_inside(region, held);
    for (const Region& feature : options.features) {
        require_same_topology(mesh, feature.topology(), "a feature");
    }
    require_features(region, held, options.features);
    state_ = std::make_unique<State>(mesh, region, held, options, context);
}

BoundaryDeformer::~BoundaryDeformer() = default;
BoundaryDeformer::BoundaryDeformer(BoundaryDeformer&&) noexcept = default;
BoundaryDeformer& BoundaryDeformer::operator=(BoundaryDeformer&&) noexcept = default;

const Region& BoundaryDeformer::region() const {
    return state_->region;
}
const Region& BoundaryDeformer::held() const {
    return state_->held;
}
const DeformStats& BoundaryDeformer::stats() const {
    return state_->stats;
}

BoundaryDeformation BoundaryDeformer::solve(std::span<const BoundaryValue> values,
                                            const Context& context) {
    State& state = *state_;
    require_values(values, state.held.size());
    state.values.assign(values.begin(), values.end());
    state.base = state.find_base();
    state.place_held();
    const bool has_free = !state.second->free_vertices().empty();
    BoundaryTimes seconds;
    auto start = Clock::now();
    if (has_free) state.solve_first();
    state.common->release_first(state.deviation, state.known_turn);
    seconds.first = seconds_since(start);
    context.checkpoint();
    start = Clock::now();
    state.find_turns(context);
    seconds.polar = seconds_since(start);
    start = Clock::now();
    if (has_free || state.common->size() > 0) state.solve_second(context);
    seconds.second = seconds_since(start);
    BoundaryDeformation deformed = state.result();
    deformed.seconds = seconds;
    return deformed;
}

BoundaryDeformation BoundaryDeformer::refine(int steps, const Context& context) {
    State& state = *state_;
    require(steps > 0, "a refinement takes at least one step");
    require(!state.values.empty(), "solve must be called before refine");
    const auto start = Clock::now();
    const bool has_free = !state.second->free_vertices().empty();
    std::vector<double> energy;
    if (has_free) energy = state.refine(steps, context);
    BoundaryDeformation deformed = state.result();
    deformed.energy = std::move(energy);
    deformed.seconds.second = seconds_since(start);
    return deformed;
}

}  // namespace lissom
