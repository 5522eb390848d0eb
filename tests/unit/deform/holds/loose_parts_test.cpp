// Parts that nothing holds: an error, they stay, or they follow what is near them.
#include <Eigen/Geometry>
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/deformer.h"
#include "kernel/deform/handle_basis.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

/// A bar along y with a button beside its middle, one at its high end, and a single vertex.
struct Dressed {
    Scene scene;
    std::vector<Index> middle, top;
    Index speck = kNoIndex;
};

Mesh button_at(const Vec3& place) {
    Mesh ball = make_sphere({0.08, 4});
    for (Vec3& p : ball.edit_positions()) p += place;
    return ball;
}

Dressed dressed() {
    Dressed d;
    const Mesh bar = make_bar({1.0, 5.0, 6, 30});
    std::vector<Vec3> positions;
    FaceList faces;
    const auto add = [&](const Mesh& mesh) {
        const Index first = count_of(positions);
        positions.insert(positions.end(), mesh.positions().begin(), mesh.positions().end());
        for (Index f = 0; f < mesh.face_count(); ++f) {
            std::vector<Index> corners;
            for (const Index v : mesh.topology().face(f)) corners.push_back(first + v);
            faces.add(corners);
        }
        std::vector<Index> all;
        for (Index v = first; v < count_of(positions); ++v) all.push_back(v);
        return all;
    };
    const std::vector<Index> body = add(bar);
    const double middle = 0.5 * (bounds(bar).min.y() + bounds(bar).max.y());
    d.middle = add(button_at({0.6, middle, 0.1}));
    d.top = add(button_at({0.6, bounds(bar).max.y() - 0.1, 0.1}));
    positions.emplace_back(0.6, middle + 0.5, 0.0);
    d.speck = count_of(positions) - 1;
    Scene ends = make_scene(bar);
    d.scene = {Mesh(std::move(positions), std::move(faces)), ends.low, ends.high, ends.size,
               ends.across};
    return d;
}

DeformOptions loose(UnheldParts what) {
    DeformOptions options;
    options.loose = what;
    return options;
}

std::vector<Vec3> picked(const std::vector<Vec3>& x, const std::vector<Index>& which) {
    std::vector<Vec3> result;
    for (const Index v : which) result.push_back(x[v]);
    return result;
}

/// How much distances within the vertices differ from those at rest.
double strain(const Dressed& d, const std::vector<Vec3>& x, const std::vector<Index>& which) {
    double most = 0.0;
    for (const Index a : which) {
        for (const Index b : which) {
            const double rest = (d.scene.mesh.position(a) - d.scene.mesh.position(b)).norm();
            most = std::max(most, std::abs((x[a] - x[b]).norm() - rest));
        }
    }
    return most;
}

}  // namespace

TEST_CASE("loose parts: an error that names the options, as long as none is asked for") {
    const Dressed d = dressed();
    Edit edit = make_edit(d.scene);
    std::string message;
    try {
        edit.deformer.solve();
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::unconstrained);
        CHECK(error.elements().count == 2);
        message = error.what();
    }
    CHECK(message.find("loose = 'stay'") != std::string::npos);
    CHECK(message.find("loose = 'follow'") != std::string::npos);
}

TEST_CASE("loose parts: they stay to the bit, and the rest moves as without them") {
    const Dressed d = dressed();
    Edit edit = make_edit(d.scene, loose(UnheldParts::stay));
    Deformer& deformer = edit.deformer;
    deformer.set_transform(edit.high, bend(d.scene, deformer.handle(edit.high).center));
    const Scene plain = make_scene(make_bar({1.0, 5.0, 6, 30}));
    Edit alone = make_edit(plain);
    alone.deformer.set_transform(alone.high, deformer.pose(edit.high).transform);
    for (const bool preview : {false, true}) {
        const std::vector<Vec3>& x =
            preview ? deformer.solve(FrameQuality::preview) : deformer.solve();
        const std::vector<Vec3>& bar =
            preview ? alone.deformer.solve(FrameQuality::preview) : alone.deformer.solve();
        for (const std::vector<Index>* part : {&d.middle, &d.top}) {
            CHECK(picked(x, *part) == picked(rest_positions_of(deformer), *part));
        }
        CHECK(x[d.speck] == d.scene.mesh.position(d.speck));
        const std::vector<Vec3> body(x.begin(), x.begin() + plain.mesh.vertex_count());
        // The surface's radius, by which a blend fades, is that of all parts.
        CHECK(max_distance(body, bar) < 0.01 * d.scene.size);
    }
}

TEST_CASE("loose parts: they follow as rigid pieces and keep their distance") {
    const Dressed d = dressed();
    for (const int refine : {0, 2}) {
        DeformOptions options = loose(UnheldParts::follow);
        options.refine = refine;
        Edit edit = make_edit(d.scene, options);
        Deformer& deformer = edit.deformer;
        for (const double angle : {0.9, 2.5, 5.0}) {
            const Affine map = rotation(d.scene.across, angle, deformer.handle(edit.high).center);
            deformer.set_transform(edit.high, map, Vec3::Zero(), angle * d.scene.across);
            for (const bool preview : {false, true}) {
                const std::vector<Vec3>& x =
                    preview ? deformer.solve(FrameQuality::preview) : deformer.solve();
                CHECK(strain(d, x, d.middle) < 1e-9);
                CHECK(max_distance(picked(x, d.top),
                                   mapped(picked(rest_positions_of(deformer), d.top), map)) < 1e-9);
                CHECK((x[d.middle.front()] - d.scene.mesh.position(d.middle.front())).norm() >
                      0.05);
                if (preview) continue;
                CHECK(gradients_of(deformer)[d.top.front()].isApprox(map.linear, 1e-9));
            }
        }
    }
}

TEST_CASE("loose parts: what follows is near what it was near") {
    const Dressed d = dressed();
    Edit edit = make_edit(d.scene, loose(UnheldParts::follow));
    Deformer& deformer = edit.deformer;
    deformer.set_transform(edit.high, bend(d.scene, deformer.handle(edit.high).center));
    const std::vector<Vec3> x = deformer.solve();
    const auto gap = [&](const std::vector<Vec3>& at, Index v) {
        double least = 1e300;
        for (Index b = 0; b < d.middle.front(); ++b)
            least = std::min(least, (at[v] - at[b]).norm());
        return least;
    };
    for (const Index v : {d.middle.front(), d.middle.back(), d.speck}) {
        CHECK(gap(x, v) == doctest::Approx(gap(rest_positions_of(deformer), v)).epsilon(0.3));
    }
}

TEST_CASE("loose parts: a similarity of all handles takes them along, and rest is to the bit") {
    const Dressed d = dressed();
    DeformOptions options = loose(UnheldParts::follow);
    options.local_size = LocalSize::scale;
    Edit edit = make_edit(d.scene, options);
    Deformer& deformer = edit.deformer;
    CHECK(deformer.solve() == rest_positions_of(deformer));
    const Affine map = rotation({1, 2, 0}, 1.0, {0, 0, 1}) * scaling({2, 2, 2}, Vec3::Zero());
    deformer.set_transform(edit.low, map);
    deformer.set_transform(edit.high, map);
    CHECK(max_distance(deformer.solve(), mapped(rest_positions_of(deformer), map)) < 1e-8);
}

TEST_CASE("loose parts: they follow quads that share opposite corners") {
    // A strip of quads, the middle one parted in two from corner to corner, and a ball above it.
    std::vector<Vec3> positions;
    FaceList faces;
    constexpr Index kLong = 10, kWide = 3, kRow = kWide + 1, kMiddle = 4;
    for (Index i = 0; i <= kLong; ++i) {
        for (Index j = 0; j <= kWide; ++j) positions.emplace_back(i, 0.1 * (i % 2), j);
    }
    const auto middle = count_of(positions);
    positions.emplace_back(kMiddle + 0.5, 0.05, 1.5);
    for (Index i = 0; i < kLong; ++i) {
        for (Index j = 0; j < kWide; ++j) {
            const Index a = i * kRow + j, b = a + 1, c = a + kRow + 1, d = a + kRow;
            if (i == kMiddle && j == 1) {
                faces.add({a, b, c, middle});
                faces.add({a, middle, c, d});
            } else {
                faces.add({a, b, c, d});
            }
        }
    }
    const Mesh ball = button_at({kMiddle + 0.5, 0.3, 1.5});
    const auto first = count_of(positions);
    positions.insert(positions.end(), ball.positions().begin(), ball.positions().end());
    for (Index f = 0; f < ball.face_count(); ++f) {
        std::vector<Index> corners;
        for (const Index v : ball.topology().face(f)) corners.push_back(first + v);
        faces.add(corners);
    }
    const Mesh mesh(std::move(positions), std::move(faces));
    for (const int refine : {0, 2}) {
        DeformOptions options = loose(UnheldParts::follow);
        options.refine = refine;
        Deformer deformer(mesh, Region::all(mesh.shared_topology()), options);
        deformer.add_handle(Region(mesh.shared_topology(), {0, 1, 2, 3, 4, 5, 6, 7}));
        std::vector<Index> end;
        for (Index v = (kLong - 1) * kRow; v < middle; ++v) end.push_back(v);
        const HandleId high = deformer.add_handle(Region(mesh.shared_topology(), end));
        deformer.set_transform(high, rotation(Vec3::UnitZ(), 0.8, deformer.handle(high).center));
        const std::vector<Vec3>& x = deformer.solve();
        const double rest = (mesh.position(first) - mesh.position(middle)).norm();
        CHECK((x[first] - mesh.position(first)).norm() > 0.05);
        CHECK((x[first] - x[middle]).norm() == doctest::Approx(rest).epsilon(0.2));
    }
}

namespace {

std::vector<Vec3> of_basis(const HandleBasis& basis, const Deformer& deformer) {
    std::vector<Vec3> x = basis.fixed;
    for (std::size_t h = 0; h < basis.handles.size(); ++h) {
        const Affine& t = deformer.pose(basis.handles[h]).transform;
        for (std::size_t row = 0; row < x.size(); ++row) {
            const Vec4& w = basis.weights[h][row];
            x[row] += t.linear * w.head<3>() + w[3] * t.translation;
        }
    }
    return x;
}

}  // namespace

TEST_CASE("loose parts: in a basis they stay, or follow by an affine map") {
    const Dressed d = dressed();
    Edit still = make_edit(d.scene, loose(UnheldParts::stay));
    const HandleBasis basis = basis_of(still.deformer);
    for (const Index v : d.middle) CHECK(basis.fixed[v] == d.scene.mesh.position(v));

    Edit edit = make_edit(d.scene, loose(UnheldParts::follow));
    Deformer& deformer = edit.deformer;
    const HandleBasis follows = basis_of(deformer);
    CHECK(max_distance(of_basis(follows, deformer), rest_positions_of(deformer)) < 1e-9);
    const Affine map = rotation({1, 2, 0}, 1.0, {0, 0, 1}) * scaling({2, 1, 3}, Vec3::Zero());
    deformer.set_transform(edit.low, map);
    deformer.set_transform(edit.high, map);
    CHECK(max_distance(of_basis(follows, deformer), mapped(rest_positions_of(deformer), map)) <
          1e-9);
    deformer.set_transform(edit.low, {});
    deformer.set_transform(edit.high,
                           rotation(d.scene.across, 0.3, deformer.handle(edit.high).center));
    const std::vector<Vec3> x = of_basis(follows, deformer),
                            shown = deformer.solve(FrameQuality::preview);
    for (const std::vector<Index>* part : {&d.middle, &d.top}) {
        CHECK(max_distance(picked(x, *part), picked(shown, *part)) < 0.05 * d.scene.size);
    }
    const std::vector<Vec3> body(x.begin(), x.begin() + d.middle.front());
    const std::vector<Vec3> body_shown(shown.begin(), shown.begin() + d.middle.front());
    CHECK(max_distance(body, body_shown) < 1e-9);
}
