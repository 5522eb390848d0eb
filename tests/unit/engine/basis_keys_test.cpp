// Key poses beside a basis: full solutions at the keys, blended between them.
#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <vector>

#include "kernel/deform/deformed_surface.h"
#include "tests/unit/engine/basis_scene.h"
#include "tests/unit/engine/header_in_c.h"

using namespace lissom;
using namespace lissom::test;

namespace {

// A bar on one end, whose other end turns.
struct KeyedBar {
    KeyedBar() : mesh(make_bar({})), edit(mesh), size(surface_radius(mesh)) {
        edit.add_handle(*mesh.find_region("bottom"));
        top = edit.add_handle(*mesh.find_region("top"));
    }

    std::vector<Affine> pose(const Vec3& axis, double degrees) const {
        return {Affine(), rotation(axis, degrees * kDegree, edit.handle(top).center)};
    }

    std::vector<Vec3> solved(const std::vector<Affine>& transforms) {
        const std::vector<std::vector<Affine>> poses{transforms};
        return make_basis_keys(edit, poses)[0].positions;
    }

    Mesh mesh;
    Deformer edit;
    HandleId top{};
    double size;
};

EngineBasis keyed(KeyedBar& bar, const std::vector<std::vector<Affine>>& poses) {
    EngineBasis basis = make_engine_basis(bar.edit);
    set_keys(basis, make_basis_keys(bar.edit, poses));
    return basis;
}

// The C evaluator and the kernel's give the same; the greatest distance to points, in sizes.
double error_of(const EngineBasis& basis, const std::vector<Affine>& transforms,
                const std::vector<Vec3>& wanted, double size) {
    const std::string bytes = encode_basis(basis);
    lissom_basis open;
    REQUIRE(lissom_basis_open(&open, bytes.data(), bytes.size()) == LISSOM_BASIS_OK);
    std::vector<float> out(3 * std::size_t{open.vertex_count});
    const std::vector<double> rows = rows_of(transforms);
    REQUIRE(evaluate_in_c(bytes.data(), bytes.size(), rows.data(), transforms.size(), 0,
                          open.vertex_count, out.data()) == 0);
    CHECK(max_distance(out, open.origin, decode_basis(bytes).positions(transforms)) < 1e-5 * size);
    return max_distance(out, open.origin, wanted) / size;
}

std::vector<double> every_45_degrees() {
    return {-170, -135, -90, -45, 45, 90, 135, 170};
}

std::vector<std::vector<Affine>> poses_about_z(const KeyedBar& bar) {
    std::vector<std::vector<Affine>> poses;
    for (const double angle : every_45_degrees()) poses.push_back(bar.pose(Vec3::UnitZ(), angle));
    return poses;
}

}  // namespace

TEST_CASE("at a key pose a basis gives the full solution, as C and in the kernel") {
    KeyedBar bar;
    const EngineBasis basis = keyed(bar, poses_about_z(bar));
    for (const auto& pose : poses_about_z(bar)) {
        CHECK(error_of(basis, pose, bar.solved(pose), bar.size) < 1e-5);
    }
}

TEST_CASE(
    "between keys every 45 degrees a basis errs as the guide tells, a tenth of the basis alone") {
    KeyedBar bar;
    const EngineBasis plain = make_engine_basis(bar.edit);
    const EngineBasis basis = keyed(bar, poses_about_z(bar));
    const std::map<double, double> told{{10, .0005}, {30, .0011}, {50, .0006}, {70, .003},
                                        {90, 0},     {110, .01},  {130, .005}, {150, .02},
                                        {170, 0},    {-70, .003}};
    for (const auto& [angle, error] : told) {
        const auto pose = bar.pose(Vec3::UnitZ(), angle);
        const std::vector<Vec3> wanted = bar.solved(pose);
        const double without = error_of(plain, pose, wanted, bar.size);
        const double with = error_of(basis, pose, wanted, bar.size);
        MESSAGE(angle << " degrees: " << without << " without keys, " << with << " with them");
        CHECK(with < 0.1 * without);
        CHECK(with <= 1.2 * error + 1e-5);
    }
}

TEST_CASE("a pose across the keys keeps the basis, and one beyond them the last offset") {
    KeyedBar bar;
    const EngineBasis plain = make_engine_basis(bar.edit);
    const EngineBasis basis =
        keyed(bar, {bar.pose(Vec3::UnitZ(), 30), bar.pose(Vec3::UnitZ(), 60)});
    const auto across = bar.pose(Vec3::UnitX(), 90), beyond = bar.pose(Vec3::UnitZ(), -60);
    for (const auto& pose : {across, beyond}) {
        CHECK(error_of(basis, pose, plain.positions(pose), bar.size) < 1e-5);
    }
    const auto far = bar.pose(Vec3::UnitZ(), 100), last = bar.pose(Vec3::UnitZ(), 60);
    const std::vector<Vec3> kept = basis.positions(last), base = plain.positions(last);
    std::vector<Vec3> wanted = plain.positions(far);
    for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] += kept[i] - base[i];
    CHECK(error_of(basis, far, wanted, bar.size) < 1e-5);
}

TEST_CASE("keys of several handles, with moves and scales, are met and blended") {
    KeyedBar bar;
    std::vector<std::vector<Affine>> poses;
    std::mt19937 random(7);
    for (int k = 0; k < 20; ++k) {
        poses.push_back({some_move(bar.edit.handle(bar.edit.handles()[0]).center, bar.size, random),
                         some_move(bar.edit.handle(bar.top).center, bar.size, random) *
                             scaling(Vec3(1.1, 0.9, 1.2), Vec3::Zero())});
    }
    const EngineBasis basis = keyed(bar, poses);
    for (const auto& pose : poses) {
        CHECK(error_of(basis, pose, bar.solved(pose), bar.size) < 1e-4);
    }
}

TEST_CASE("with keys too, handles at the identity give the rest shape to the bit") {
    KeyedBar bar;
    const std::string bytes = encode_basis(keyed(bar, poses_about_z(bar)));
    lissom_basis basis;
    REQUIRE(lissom_basis_open(&basis, bytes.data(), bytes.size()) == LISSOM_BASIS_OK);
    CHECK(basis.key_count == 8);
    std::vector<float> still(24), out(3 * std::size_t{basis.vertex_count});
    for (std::size_t h = 0; h < 2; ++h) lissom_basis_identity(still.data() + 12 * h);
    lissom_basis_evaluate(&basis, still.data(), 0, basis.vertex_count, out.data(), 12);
    CHECK(std::memcmp(out.data(), basis.rest, out.size() * sizeof(float)) == 0);
}

TEST_CASE("the rest pose is a key too if point constraints move the surface at rest") {
    KeyedBar bar;
    for (Index v = 0; v < bar.mesh.vertex_count(); ++v) {
        if (std::abs(places_along(bar.mesh)[at(v)] - 0.5) > 0.02) continue;
        bar.edit.constrain(
            VertexConstraint{v, bar.mesh.position(v) + Vec3(0.5, 0.2, 0), std::nullopt});
    }
    const std::vector<std::vector<Affine>> poses{bar.pose(Vec3::UnitZ(), 0),
                                                 bar.pose(Vec3::UnitZ(), 60)};
    const EngineBasis basis = keyed(bar, poses);
    for (const auto& pose : poses) {
        CHECK(error_of(basis, pose, bar.solved(pose), bar.size) < 1e-5);
    }
}

TEST_CASE("programs that do not know key poses read the basis before them") {
    KeyedBar bar;
    const std::string plain = encode_basis(make_engine_basis(bar.edit));
    const std::string bytes = encode_basis(keyed(bar, poses_about_z(bar)));
    CHECK(bytes.substr(0, plain.size()) == plain);
    CHECK(decode_basis(plain).keys.empty());
    CHECK(encode_basis(decode_basis(bytes)) == bytes);
}

TEST_CASE("keys that are the same pose, too many or of another basis are refused") {
    KeyedBar bar;
    EngineBasis basis = make_engine_basis(bar.edit);
    const auto code_of = [&](const std::vector<BasisKey>& keys) {
        try {
            set_keys(basis, keys);
        } catch (const Error& error) {
            return error.code();
        }
        return ErrorCode::internal;
    };
    const std::vector<std::vector<Affine>> halves{bar.pose(Vec3::UnitZ(), 180),
                                                  bar.pose(Vec3::UnitZ(), -180)};
    const std::vector<BasisKey> half = make_basis_keys(bar.edit, halves);
    CHECK(code_of(half) == ErrorCode::invalid_argument);
    CHECK(code_of(std::vector<BasisKey>(257, half[0])) == ErrorCode::invalid_argument);
    CHECK(code_of({BasisKey{{Affine()}, half[0].positions}}) == ErrorCode::invalid_argument);
    CHECK(basis.keys.empty());
    set_keys(basis, std::vector{half[0]});
    CHECK(error_of(basis, half[0].transforms, half[0].positions, bar.size) < 1e-5);
}

TEST_CASE("damaged key poses are refused, and whatever is opened is evaluated inside its memory") {
    KeyedBar bar;
    const std::string good = encode_basis(keyed(bar, {bar.pose(Vec3::UnitZ(), 30)}));
    const std::size_t first = good.find("LSMBKEYS");
    std::mt19937 random(3);
    int refused = 0;
    for (int i = 0; i < 600; ++i) {
        std::string bytes = good;
        if (i % 2 == 0) {
            bytes.resize(first + 8 + random() % (bytes.size() - first - 8));
        } else {
            bytes[first + random() % 200] ^= static_cast<char>(1 << random() % 8);
        }
        const std::vector<std::uint32_t> memory(bytes.size() / 4 + 1);
        auto copy = memory;
        std::memcpy(copy.data(), bytes.data(), bytes.size());
        lissom_basis basis;
        bool is_read = true;
        try {
            decode_basis(bytes);
        } catch (const Error&) {
            is_read = false;
        }
        refused += is_read ? 0 : 1;
        if (lissom_basis_open(&basis, copy.data(), bytes.size()) != LISSOM_BASIS_OK) {
            CHECK_FALSE(is_read);
            continue;
        }
        std::vector<float> transforms(24, 0.5f), out(3 * std::size_t{basis.vertex_count});
        lissom_basis_evaluate(&basis, transforms.data(), 0, basis.vertex_count, out.data(), 12);
    }
    CHECK(refused > 300);
}
