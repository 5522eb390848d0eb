#include "kernel/deform/boundary/boundary_deformer.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/stats.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/query/region_select.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/thesis_options.h"

using namespace lissom;

namespace {

// A bumpy bowl, open at the top: its boundary holds it.
Mesh bowl() {
    GridOptions grid;
    grid.size = {2.0, 2.0};
    grid.segments = {24, 24};
    Mesh mesh = make_grid(grid);
    for (Vec3& p : mesh.edit_positions()) {
        p.y() = 0.5 * p.squaredNorm() + 0.06 * std::sin(9.0 * p.x()) * std::cos(7.0 * p.z());
    }
    return mesh;
}

Region rim(const Mesh& mesh) {
    return Region(mesh.shared_topology(), mesh.topology().boundary_loops()[0]);
}

Affine similarity(double scale, const Vec3& axis, double angle, const Vec3& move) {
    Affine map = rotation(axis, angle, Vec3::Zero());
    map.linear *= scale;
    map.translation = move;
    return map;
}

std::vector<BoundaryValue> moved(const Mesh& mesh, const Region& held, const Affine& map) {
    std::vector<BoundaryValue> values;
    const double scale = std::cbrt(map.linear.determinant());
    for (const Index v : held.vertices()) {
        values.push_back({map(mesh.position(v)), map.linear / scale, scale});
    }
    return values;
}

// Values that no similarity gives: the rim is bent, and grows to one side.
std::vector<BoundaryValue> bent(const Mesh& mesh, const Region& held) {
    std::vector<BoundaryValue> values;
    for (const Index v : held.vertices()) {
        const Vec3& p = mesh.position(v);
        const Affine turn = rotation(Vec3::UnitZ(), 0.5 * p.x(), Vec3::Zero());
        values.push_back({turn(p) + Vec3(0, 0.3 * p.z(), 0), turn.linear, 1.0 + 0.2 * p.x()});
    }
    return values;
}

// Two patches of the bowl.
std::vector<Region> two_bumps(const Mesh& mesh) {
    std::vector<Region> result;
    for (const Vec3& at : {Vec3(-0.4, 0.1, 0.0), Vec3(0.5, 0.2, 0.2)}) {
        std::vector<Index> near;
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            if ((mesh.position(v) - at).norm() < 0.3) near.push_back(v);
        }
        result.emplace_back(mesh.shared_topology(), near);
    }
    return result;
}

double max_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double greatest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, (a[i] - b[i]).norm());
    return greatest;
}

}  // namespace

TEST_CASE("a similarity of the boundary is one of the whole surface, in every formulation") {
    const Mesh mesh = bowl();
    const Region held = rim(mesh), all = Region::all(mesh.shared_topology());
    const Affine map = similarity(37.0, Vec3(1, 2, -1), 2.8, Vec3(1e4, -300, 8));
    BoundaryDeformOptions poisson, thesis = test::thesis_or_default_boundary();
    poisson.second = SecondSystem::poisson;
    poisson.size = SizeField::gradient;
    BoundaryDeformOptions featured = thesis;
    featured.features = two_bumps(mesh);
    for (const BoundaryDeformOptions& how : {BoundaryDeformOptions{}, poisson, thesis, featured}) {
        BoundaryDeformer deformer(mesh, all, held, how);
        const BoundaryDeformation result = deformer.solve(moved(mesh, held, map));
        std::vector<Vec3> expected;
        for (const Vec3& p : mesh.positions()) expected.push_back(map(p));
        CHECK(max_difference(result.positions, expected) < 1e-9 * 37.0);
        for (const Mat3& s : result.transforms) CHECK((s - map.linear).norm() < 1e-8);
    }
}

TEST_CASE("held vertices lie where they are told, to the bit") {
    const Mesh mesh = bowl();
    const Region held = rim(mesh), all = Region::all(mesh.shared_topology());
    BoundaryDeformer deformer(mesh, all, held);
    const std::vector<BoundaryValue> values = bent(mesh, held);
    const BoundaryDeformation result = deformer.solve(values);
    for (std::size_t i = 0; i < values.size(); ++i) {
        CHECK(result.positions[held.vertices()[i]] == values[i].position);
    }
}

TEST_CASE("the result follows the boundary whatever the place, turn and size of the rest shape") {
    const Mesh mesh = bowl();
    const Region held = rim(mesh), all = Region::all(mesh.shared_topology());
    const std::vector<BoundaryValue> values = bent(mesh, held);
    BoundaryDeformer reference(mesh, all, held);
    const std::vector<Vec3> expected = reference.solve(values).positions;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int trial = 0; trial < 12; ++trial) {
        const Affine map =
            similarity(std::pow(10.0, 3.0 * unit(random)), Vec3(unit(random), unit(random), 1.0),
                       3.0 * unit(random), 100.0 * Vec3(unit(random), unit(random), unit(random)));
        Mesh other = mesh;
        for (Vec3& p : other.edit_positions()) p = map(p);
        const double scale = std::cbrt(map.linear.determinant());
        std::vector<BoundaryValue> same = values;
        for (BoundaryValue& value : same) {
            value.rotation = value.rotation * (map.linear / scale).transpose();
            value.scale /= scale;
        }
        BoundaryDeformer deformer(other, Region::all(other.shared_topology()),
                                  Region(other.shared_topology(), held.vertices()));
        const std::vector<Vec3> result = deformer.solve(same).positions;
        // What lies far away in small steps has few digits to begin with.
        const double digits = 1e-16 * map.translation.norm() / scale;
        CHECK(max_difference(result, expected) < 1e-9 + 1e3 * digits);
    }
}

TEST_CASE("sizes lie between those of the boundary, and are one where they are one") {
    const Mesh mesh = bowl();
    const Region held = rim(mesh), all = Region::all(mesh.shared_topology());
    BoundaryDeformer deformer(mesh, all, held);
    for (const Mat3& s : deformer.solve(bent(mesh, held)).transforms) {
        CHECK(uniform_scale(s) > 0.8 - 1e-9);
        CHECK(uniform_scale(s) < 1.2 + 1e-9);
    }
    std::vector<BoundaryValue> twice = bent(mesh, held);
    for (BoundaryValue& value : twice) value.scale = 2.0;
    for (const Mat3& s : deformer.solve(twice).transforms) {
        CHECK(uniform_scale(s) == doctest::Approx(2.0).epsilon(1e-9));
    }
}

TEST_CASE("outside the region nothing moves, and new values need no factorisation") {
    const Mesh mesh = bowl();
    const Region held = rim(mesh);
    const Region region = held.grown(6);
    BoundaryDeformer deformer(mesh, region, held);
    CHECK(deformer.stats().free_vertices == region.size() - held.size());
    const BoundaryDeformation still = deformer.solve(moved(mesh, held, Affine{}));
    for (Index row = 0; row < region.size(); ++row) {
        CHECK((still.positions[row] - mesh.position(region.vertices()[row])).norm() < 1e-12);
    }
    CHECK(deformer.solve(bent(mesh, held)).positions != still.positions);
    CHECK(deformer.stats().factorizations == 1);
}

TEST_CASE("what cannot be solved is refused by name") {
    const Mesh mesh = bowl();
    const auto topology = mesh.shared_topology();
    const Region held = rim(mesh);
    const auto code_of = [&](const Region& region, const Region& fixed) {
        try {
            const BoundaryDeformer deformer(mesh, region, fixed);
        } catch (const Error& error) {
            return error.code();
        }
        return ErrorCode::internal;
    };
    CHECK(code_of(Region::all(topology), Region::none(topology)) == ErrorCode::region_empty);
    CHECK(code_of(held.inverted(), held) == ErrorCode::handle_outside_region);
    BoundaryDeformer deformer(mesh, Region::all(topology), held);
    std::vector<BoundaryValue> values = moved(mesh, held, Affine{});
    values.pop_back();
    CHECK_THROWS_AS(deformer.solve(values), Error);
    values.push_back({Vec3::Zero(), Mat3::Identity(), 0.0});
    CHECK_THROWS_AS(deformer.solve(values), Error);
    values.back() = {Vec3::Constant(std::nan("")), Mat3::Identity(), 1.0};
    CHECK_THROWS_AS(deformer.solve(values), Error);
}

TEST_CASE("features keep their shape, each by a similarity of its own that is an unknown") {
    const Mesh mesh = bowl();
    const Region held = rim(mesh), all = Region::all(mesh.shared_topology());
    BoundaryDeformOptions ours, thesis = test::thesis_or_default_boundary();
    for (BoundaryDeformOptions how : {ours, thesis}) {
        BoundaryDeformer without(mesh, all, held, how);
        how.features = two_bumps(mesh);
        BoundaryDeformer deformer(mesh, all, held, how);
        const BoundaryDeformation free = without.solve(bent(mesh, held));
        const BoundaryDeformation result = deformer.solve(bent(mesh, held));
        std::vector<Mat3> turns;
        for (const Region& feature : how.features) {
            const Index first = feature.vertices().front();
            const Mat3& m = result.transforms[first];
            for (const Index v : feature.vertices()) {
                const Vec3 arm = m * (mesh.position(v) - mesh.position(first));
                CHECK((result.positions[v] - result.positions[first] - arm).norm() < 1e-9);
            }
            const double scale = std::cbrt(m.determinant());
            CHECK((m.transpose() * m - scale * scale * Mat3::Identity()).norm() < 1e-9);
            // Near where the surface without features has it.
            CHECK((result.positions[first] - free.positions[first]).norm() < 0.2);
            CHECK((m - free.transforms[first]).norm() < 0.5);
            turns.push_back(m / scale);
        }
        CHECK((turns[0] - turns[1]).norm() > 0.1);
        // Values are new, factors are not.
        const BoundaryDeformation again = deformer.solve(bent(mesh, held));
        CHECK(max_difference(result.positions, again.positions) == 0.0);
    }
    BoundaryDeformOptions wrong;
    wrong.features = {held};
    CHECK_THROWS_AS(BoundaryDeformer(mesh, all, held, wrong), Error);
    wrong.features = {two_bumps(mesh)[0], two_bumps(mesh)[0]};
    CHECK_THROWS_AS(BoundaryDeformer(mesh, all, held, wrong), Error);
}

namespace {

// Mean by area of (s1 - 1)^2 + (s2 - 1)^2, s1 and s2 the singular values of the faces' maps.
double stretch_energy(const Mesh& rest, const std::vector<Vec3>& positions) {
    double sum = 0.0, area = 0.0;
    for (Index f = 0; f < rest.face_count(); ++f) {
        const std::span<const Index> face = rest.topology().face(f);
        for (std::size_t k = 1; k + 1 < face.size(); ++k) {
            const auto flat = [&](const auto& at) {
                const Vec3 u = at(face[k]) - at(face[0]), v = at(face[k + 1]) - at(face[0]);
                Eigen::Matrix2d m;
                m << u.norm(), u.dot(v) / u.norm(), 0.0, u.cross(v).norm() / u.norm();
                return m;
            };
            const Eigen::Matrix2d before = flat([&](Index v) { return rest.position(v); });
            const Eigen::Matrix2d after = flat([&](Index v) { return positions[at(v)]; });
            const Eigen::Vector2d s = (after * before.inverse()).jacobiSvd().singularValues();
            const double size = before.determinant();
            sum += size * (std::pow(s[0] - 1.0, 2) + std::pow(s[1] - 1.0, 2));
            area += size;
        }
    }
    return sum / area;
}

// Values that turn the rim of the bowl by up to `angle` to either side, without growing it.
std::vector<BoundaryValue> bent_alone(const Mesh& mesh, const Region& held, double angle) {
    std::vector<BoundaryValue> values;
    for (const Index v : held.vertices()) {
        const Vec3& p = mesh.position(v);
        const Affine turn = rotation(Vec3::UnitZ(), angle * p.x(), Vec3::Zero());
        values.push_back({turn(p) + Vec3(0, 0.3 * p.z(), 0), turn.linear, 1.0});
    }
    return values;
}

void check_falls(const std::vector<double>& energy) {
    for (std::size_t k = 1; k < energy.size(); ++k) CHECK(energy[k] < energy[k - 1]);
}

}  // namespace

TEST_CASE("refined, the energy falls with every step, and the surface is stretched no more") {
    const Mesh mesh = bowl();
    const Region held = rim(mesh), all = Region::all(mesh.shared_topology());
    BoundaryDeformer deformer(mesh, all, held);
    for (const double angle : {0.1, 0.5, 1.5}) {
        CAPTURE(angle);
        const std::vector<BoundaryValue> values = bent_alone(mesh, held, angle);
        const BoundaryDeformation plain = deformer.solve(values);
        const BoundaryDeformation refined = deformer.refine(20);
        CHECK(refined.energy.size() > 2);
        check_falls(refined.energy);
        CHECK(stretch_energy(mesh, refined.positions) < stretch_energy(mesh, plain.positions));
        for (std::size_t i = 0; i < values.size(); ++i) {
            CHECK(refined.positions[at(held.vertices()[i])] == values[i].position);
        }
        // It goes on where it stopped, and begins anew with the next solution.
        const BoundaryDeformation further = deformer.refine(20);
        CHECK(further.energy.front() == refined.energy.back());
        check_falls(further.energy);
        deformer.solve(values);
        CHECK(deformer.refine(20).positions == refined.positions);
    }
}

TEST_CASE("refined, what was turned at random has less energy") {
    const Mesh mesh = bowl();
    const Region held = rim(mesh), all = Region::all(mesh.shared_topology());
    BoundaryDeformer deformer(mesh, all, held);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> some(-1.0, 1.0);
    for (int k = 0; k < 20; ++k) {
        std::vector<BoundaryValue> values;
        const double slack = k % 2 == 0 ? 0.0 : 0.3;
        for (const Index v : held.vertices()) {
            const Vec3 axis(some(random), some(random), some(random));
            const Mat3 turn = rotation(axis.normalized(), 1.5 * some(random), Vec3::Zero()).linear;
            const Vec3 shift(some(random), some(random), some(random));
            values.push_back(
                {mesh.position(v) + 0.2 * shift, turn, std::exp(0.5 * some(random)), slack, turn});
        }
        deformer.solve(values);
        check_falls(deformer.refine(8).energy);
    }
}

TEST_CASE("refined, a similarity stays one") {
    const Mesh mesh = bowl();
    const Region held = rim(mesh), all = Region::all(mesh.shared_topology());
    BoundaryDeformer deformer(mesh, all, held);
    const Affine map = similarity(3.0, Vec3(1, 2, -1), 2.8, Vec3(10, -3, 8));
    deformer.solve(moved(mesh, held, map));
    const BoundaryDeformation same = deformer.refine(6);
    std::vector<Vec3> expected;
    for (const Vec3& p : mesh.positions()) expected.push_back(map(p));
    CHECK(max_difference(same.positions, expected) < 1e-8);
    for (const Vec3& pull : same.pulls) CHECK(pull.norm() < 1e-8);
    CHECK(same.energy.front() < 1e-12);
}

TEST_CASE("held vertices with slack turn to where there is less energy, within it") {
    const Mesh mesh = bowl();
    const Region held = rim(mesh), all = Region::all(mesh.shared_topology());
    BoundaryDeformer deformer(mesh, all, held);
    std::vector<BoundaryValue> values = bent_alone(mesh, held, 0.5);
    deformer.solve(values);
    const double firm = deformer.refine(6).energy.back();
    const double slack = 0.2;
    for (BoundaryValue& value : values) {
        value.slack = slack;
        value.upright = value.rotation;
    }
    deformer.solve(values);
    const BoundaryDeformation result = deformer.refine(6);
    CHECK(result.energy.back() < firm);
    check_falls(result.energy);
    double greatest = 0.0;
    const std::vector<Index>& ids = held.vertices();
    for (std::size_t i = 0; i < ids.size(); ++i) {
        CHECK(result.positions[at(ids[i])] == values[i].position);
        const Mat3 away = result.transforms[at(ids[i])] * values[i].rotation.transpose();
        const double angle = std::acos(std::clamp(0.5 * (away.trace() - 1.0), -1.0, 1.0));
        CHECK(angle < slack + 1e-6);
        greatest = std::max(greatest, angle);
    }
    CHECK(greatest > 0.5 * slack);
    values.front().slack = -1.0;
    CHECK_THROWS_AS(deformer.solve(values), Error);
}

TEST_CASE("pulls of held vertices lead to where there is less energy") {
    const Mesh mesh = bowl();
    const Region held = rim(mesh), all = Region::all(mesh.shared_topology());
    BoundaryDeformer deformer(mesh, all, held);
    std::vector<BoundaryValue> values = bent_alone(mesh, held, 0.5);
    double last = 1e9;
    for (int round = 0; round < 4; ++round) {
        deformer.solve(values);
        const BoundaryDeformation result = deformer.refine(4);
        CHECK(result.energy.back() < last);
        last = result.energy.back();
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i].position += 0.25 * result.pulls[i];
        }
    }
}

TEST_CASE("a refinement follows a solution") {
    const Mesh mesh = bowl();
    const Region held = rim(mesh), all = Region::all(mesh.shared_topology());
    BoundaryDeformer deformer(mesh, all, held);
    CHECK_THROWS_AS(deformer.refine(1), Error);
    deformer.solve(bent_alone(mesh, held, 0.5));
    CHECK_THROWS_AS(deformer.refine(0), Error);
}
