#include "kernel/merge/blend/band_system.h"

#include <algorithm>
#include <utility>

#include "kernel/deform/patch/row_accumulator.h"
#include "kernel/merge/sew/seam_guard.h"
#include "kernel/mesh/measure/directions.h"

namespace lissom {
namespace {

constexpr Index kRowRings = 1;
// Slivers along a seam would rule the energy; their angles count as at least this.
constexpr double kMinSeamAngle = 2.0 * kPi / 180.0;

}  // namespace

BandSystem::BandSystem(const Region& region, const Region& band, std::span<const Vec3> positions)
    : patch_(build_patch(region, positions, kRowRings, near_order(region, kRowRings))),
      rings_(build_rings(patch_.real_count, patch_.triangles)),
      row_(patch_.real_count, 0),
      unknown_(patch_.real_count, kNoIndex),
      x_(patch_.rest.begin(), patch_.rest.begin() + patch_.real_count) {
    for (Index i = 0; i < patch_.real_count; ++i) {
        if (band.contains(mesh_vertex(i))) unknown_[i] = unknown_count_++;
        if (!patch_.in_region[i]) continue;
        row_[i] = 1;
        for (const Index j : rings_.ring(i)) row_[j] = 1;
    }
    measure();
}

void BandSystem::measure() {
    geometry_ = ring_geometry(rings_, patch_.triangles, x_, kMinSeamAngle);
    laplacian_ = make_laplacian(rings_, geometry_, LaplacianWeights::cotangent, true);
}

void BandSystem::take_morphs(const Mesh& mesh) {
    for (const Attribute& attribute : mesh.attributes().all()) {
        if (!is_morph_position(attribute)) continue;
        const std::vector<Vec3> all = morph_displacements(mesh, attribute);
        Morph morph{attribute.name, {}};
        for (Index i = 0; i < vertex_count(); ++i) morph.x.push_back(all[at(mesh_vertex(i))]);
        morphs_.push_back(std::move(morph));
    }
}

std::vector<std::vector<double>> BandSystem::curvatures() const {
    std::vector<std::vector<double>> result;
    for (Index s = 0; s < shape_count(); ++s) {
        std::vector<double>& values = result.emplace_back(x_.size(), 0.0);
        for (Index i = 0; i < vertex_count(); ++i) {
            if (is_row(i)) values[at(i)] = curvature(i, s);
        }
    }
    return result;
}

// L^T A L between unknowns, column by column.
SymmetricMatrix BandSystem::normal_matrix() const {
    SymmetricMatrix matrix;
    RowAccumulator<double> column(unknown_count_);
    const auto add_row = [&](Index row, double scale) {
        const auto add = [&](Index j, double value) {
            if (unknown_[j] != kNoIndex) column.add(unknown_[j], scale * value);
        };
        add(row, laplacian_.self[row]);
        for (Index e = rings_.begin[row]; e < rings_.begin[row + 1]; ++e) {
            add(rings_.neighbor[e], laplacian_.neighbor[e]);
        }
    };
    for (Index i = 0; i < patch_.real_count; ++i) {
        if (!moves(i)) continue;
        add_row(i, laplacian_.weight[i] * laplacian_.self[i]);
        for (const Index j : rings_.ring(i)) {
            add_row(j, laplacian_.weight[j] * laplacian_.neighbor[rings_.entry(j, i)]);
        }
        column.drain([&](Index j, double value) {
            if (j < unknown_[i]) return;
            matrix.row.push_back(j);
            matrix.value.push_back(value);
        });
        matrix.begin.push_back(count_of(matrix.row));
    }
    return matrix;
}

// Solved for displacements, so that a band that has the wanted coordinates does not move.
std::vector<Vec3> BandSystem::with_curvatures(Index s, std::span<const Vec3> wanted) const {
    const std::size_t n = at(unknown_count_);
    std::vector<double> b(3 * n, 0.0);
    for (Index i = 0; i < patch_.real_count; ++i) {
        if (!is_row(i)) continue;
        const Vec3 missing = laplacian_.weight[i] * (wanted[i] - coordinates(i, s));
        const auto add = [&](Index j, double value) {
            if (unknown_[j] == kNoIndex) return;
            for (std::size_t k = 0; k < 3; ++k) b[k * n + unknown_[j]] += value * missing[k];
        };
        add(i, laplacian_.self[i]);
        for (Index e = rings_.begin[i]; e < rings_.begin[i + 1]; ++e) {
            add(rings_.neighbor[e], laplacian_.neighbor[e]);
        }
    }
    system_.solve(b, b, 3);
    std::vector<Vec3> x = shape(s);
    for (Index i = 0; i < patch_.real_count; ++i) {
        if (!moves(i)) continue;
        for (std::size_t k = 0; k < 3; ++k) x[i][k] += b[k * n + unknown_[i]];
    }
    return x;
}

void BandSystem::bend(std::span<const std::vector<Vec3>> wanted, const Context& context) {
    const SymmetricMatrix matrix = normal_matrix();
    if (system_.size() == 0) system_.analyze(matrix, context);
    system_.factor(matrix, context);
    for (Index s = 0; s < shape_count(); ++s) {
        context.checkpoint();
        set_shape(s, with_curvatures(s, wanted[at(s)]));
    }
    measure();
}

// Moves each local vertex `parts` of the way from its value in the mesh.
MorphColumns BandSystem::moved_morphs(const Mesh& mesh, std::span<const double> parts) const {
    MorphColumns columns;
    for (const Morph& morph : morphs_) {
        std::vector<Vec3> all = morph_displacements(mesh, *mesh.attributes().find(morph.name));
        for (Index i = 0; i < vertex_count(); ++i) {
            if (!moves(i)) continue;
            Vec3& here = all[at(mesh_vertex(i))];
            here += parts[at(i)] * (morph.x[at(i)] - here);
        }
        columns.emplace(morph.name, std::move(all));
    }
    return columns;
}

void BandSystem::write(Mesh& mesh) const {
    const DirectionCarrier directions(mesh);
    std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
    for (Index i = 0; i < vertex_count(); ++i) {
        if (moves(i)) positions[mesh_vertex(i)] = x_[i] + patch_.origin;
    }
    const MorphColumns morphs = moved_morphs(mesh, std::vector<double>(x_.size(), 1.0));
    mesh.set_positions(std::move(positions));
    set_morphs(mesh, morphs);
    directions.follow(mesh);
}

double BandSystem::write_guarded(Mesh& mesh, std::span<const std::vector<Index>> seams,
                                 const SeamQuality& allowed, const Context& context) const {
    std::vector<Index> locals;
    for (Index i = 0; i < vertex_count(); ++i) {
        if (moves(i)) locals.push_back(i);
    }
    std::sort(locals.begin(), locals.end(),
              [&](Index a, Index b) { return mesh_vertex(a) < mesh_vertex(b); });
    std::vector<Index> moving;
    std::vector<Vec3> to;
    for (const Index i : locals) {
        moving.push_back(mesh_vertex(i));
        to.emplace_back(x_[at(i)] + patch_.origin);
    }
    SeamGuard guard(mesh, seams, std::move(moving), context, allowed);
    const double kept = guard.move(to);
    std::vector<double> parts(x_.size(), 0.0);
    for (std::size_t k = 0; k < locals.size(); ++k) parts[at(locals[k])] = guard.parts()[k];
    const DirectionCarrier directions(mesh);
    const MorphColumns morphs = moved_morphs(mesh, parts);
    mesh.set_positions({guard.positions().begin(), guard.positions().end()});
    set_morphs(mesh, morphs);
    directions.follow(mesh);
    return kept;
}

}  // namespace lissom
