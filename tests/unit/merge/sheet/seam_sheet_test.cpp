// Triangles of a sheet while they are changed: flat ones become round, and nothing turns over.

#include "kernel/merge/sheet/seam_sheet.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

using namespace lissom;

namespace {

constexpr Index kSide = 9;

// A square of side 1 with moved inner vertices and diagonals at random, lifted by `height`.
Mesh jittered_square(unsigned seed, double jitter,
                     const std::function<double(double, double)>& height) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::vector<Vec3> positions;
    for (Index y = 0; y <= kSide; ++y) {
        for (Index x = 0; x <= kSide; ++x) {
            const bool inner = x > 0 && y > 0 && x < kSide && y < kSide;
            const double by = inner ? jitter / kSide : 0.0;
            const double px = static_cast<double>(x) / kSide + by * unit(random),
                         py = static_cast<double>(y) / kSide + by * unit(random);
            positions.emplace_back(px, py, height(px, py));
        }
    }
    FaceList faces;
    for (Index y = 0; y < kSide; ++y) {
        for (Index x = 0; x < kSide; ++x) {
            const Index a = y * (kSide + 1) + x, b = a + 1, d = a + kSide + 1, c = d + 1;
            if (unit(random) < 0.0) {
                faces.add({a, b, c});
                faces.add({a, c, d});
            } else {
                faces.add({a, b, d});
                faces.add({b, c, d});
            }
        }
    }
    return Mesh(std::move(positions), std::move(faces));
}

SeamSheet sheet_of(const Mesh& mesh, double sharp) {
    std::vector<Index> faces(static_cast<std::size_t>(mesh.face_count()));
    std::iota(faces.begin(), faces.end(), 0);
    return {mesh, faces, {}, sharp, {}};
}

Vec3 area_vector(const SeamSheet& sheet, const Triangle& t) {
    const Vec3& a = sheet.position(t[0]);
    return 0.5 * (sheet.position(t[1]) - a).cross(sheet.position(t[2]) - a);
}

double min_angle(const std::array<Vec3, 3>& p) {
    double least = kPi;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 u = p[(k + 1) % 3] - p[k], v = p[(k + 2) % 3] - p[k];
        least = std::min(least, std::atan2(u.cross(v).norm(), u.dot(v)));
    }
    return least;
}

double min_angle(const SeamSheet& sheet, Index a, Index b, Index c) {
    return min_angle({sheet.position(a), sheet.position(b), sheet.position(c)});
}

// Calls with the two triangles at every inner edge a-c, and their other corners.
void for_each_quad(
    const SeamSheet& sheet,
    const std::function<void(const Triangle&, const Triangle&, Index, Index)>& visit) {
    const std::vector<Triangle> triangles = sheet.triangles();
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        for (std::size_t g = 0; g < f; ++g) {
            std::vector<Index> only_f, only_g;
            const Triangle &s = triangles[f], &t = triangles[g];
            for (const Index v : s) {
                if (std::find(t.begin(), t.end(), v) == t.end()) only_f.push_back(v);
            }
            for (const Index v : t) {
                if (std::find(s.begin(), s.end(), v) == s.end()) only_g.push_back(v);
            }
            if (only_f.size() == 1) visit(s, t, only_f[0], only_g[0]);
        }
    }
}

double max_dihedral(const SeamSheet& sheet) {
    double greatest = 0.0;
    for_each_quad(sheet, [&](const Triangle& s, const Triangle& t, Index, Index) {
        const Vec3 n = area_vector(sheet, s), m = area_vector(sheet, t);
        greatest = std::max(greatest, std::atan2(n.cross(m).norm(), n.dot(m)));
    });
    return greatest;
}

double flat(double, double) {
    return 0.0;
}

double wavy(double x, double y) {
    return 0.1 * std::sin(5.0 * x + 1.0) * std::cos(4.0 * y);
}

}  // namespace

TEST_CASE("seam sheet: flips end where none makes the smallest angle greater") {
    for (const unsigned seed : {1u, 2u, 3u, 4u}) {
        const Mesh mesh = jittered_square(seed, 0.24, seed % 2 == 0 ? wavy : flat);
        SeamSheet sheet = sheet_of(mesh, kPi);
        Index flips = 0, round = 0;
        while (const Index some = sheet.flip_edges({kPi, kPi}, {})) {
            flips += some;
            REQUIRE(++round < 100);
        }
        CHECK(flips > 20);
        double area = 0.0;
        for (const Triangle& t : sheet.triangles()) {
            CHECK(area_vector(sheet, t).z() > 0.0);
            area += area_vector(sheet, t).z();
        }
        CHECK(area == doctest::Approx(1.0));
        for_each_quad(sheet, [&](const Triangle& s, const Triangle& t, Index p, Index q) {
            const auto k = static_cast<std::size_t>(std::find(s.begin(), s.end(), p) - s.begin());
            const Index a = s[(k + 1) % 3], c = s[(k + 2) % 3];
            const Triangle first{p, a, q}, second{p, q, c};
            const bool convex =
                area_vector(sheet, first).z() > 0.0 && area_vector(sheet, second).z() > 0.0;
            if (!convex) return;
            const double now =
                std::min(min_angle(sheet, s[0], s[1], s[2]), min_angle(sheet, t[0], t[1], t[2]));
            const double then = std::min(min_angle(sheet, p, a, q), min_angle(sheet, p, q, c));
            CHECK(then < now + 1e-5);
        });
    }
}

TEST_CASE("seam sheet: flips make no dihedral angle greater than the limits and what was there") {
    const auto ridge = [](double x, double y) { return 0.3 * std::abs(x - 0.5) + 0.02 * y * y; };
    for (const double limit : {0.0, 0.1, 0.3}) {
        const Mesh mesh = jittered_square(4, 0.3, ridge);
        SeamSheet sheet = sheet_of(mesh, kPi);
        const double before = max_dihedral(sheet);
        CHECK(sheet.flip_edges({limit, limit}, {}) > 0);
        CHECK(max_dihedral(sheet) <= std::max(before, limit) + 1e-6);
    }
}

TEST_CASE("seam sheet: remeshed edges are as long as is wanted, the border and the area stay") {
    const Mesh mesh = jittered_square(5, 0.4, flat);
    for (const double wanted : {0.06, 0.11, 0.2}) {
        SeamSheet sheet = sheet_of(mesh, 0.5);
        sheet.remesh([=](const Vec3&) { return wanted; }, {0.5, 0.5}, {0.5, 0.5}, {});
        double sum = 0.0, count = 0.0, area = 0.0;
        for (const Triangle& t : sheet.triangles()) {
            area += area_vector(sheet, t).z();
            CHECK(area_vector(sheet, t).z() > 0.0);
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 &a = sheet.position(t[k]), &b = sheet.position(t[(k + 1) % 3]);
                const auto inner = [](const Vec3& p) {
                    return std::min({p.x(), p.y(), 1.0 - p.x(), 1.0 - p.y()}) > 0.15;
                };
                if (!inner(a) || !inner(b)) continue;
                sum += (b - a).norm();
                count += 1.0;
            }
        }
        CHECK(area == doctest::Approx(1.0));
        REQUIRE(count > 0.0);
        CHECK(sum / count > 0.75 * wanted);
        CHECK(sum / count < 1.25 * wanted);
        for (Index v = 0; v < sheet.vertex_count(); ++v) {
            const Index from = sheet.mesh_vertex(v);
            if (from == kNoIndex || !mesh.topology().is_boundary(from)) continue;
            CHECK(sheet.position(v) == mesh.position(from));
        }
    }
}
