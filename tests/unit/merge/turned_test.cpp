// What turns and grows with a surface that was deformed.

#include "kernel/merge/turned.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "kernel/mesh/shapes/shapes.h"

using namespace lissom;

TEST_CASE("turned: what morphs add grows as the surface does where it stands") {
    for (const Domain domain : {Domain::vertex, Domain::corner}) {
        Mesh rest = make_sphere({.segments = 8});
        Attribute morph;
        morph.name = "morph.1.position";
        morph.domain = domain;
        morph.width = 3;
        const Index count =
            domain == Domain::vertex ? rest.vertex_count() : rest.topology().corner_count();
        for (Index i = 0; i < 3 * count; ++i) morph.values.push_back(1.0 + i % 7);
        const Attribute before = rest.attributes().add(morph);
        std::vector<Index> ids;
        for (Index v = 0; v < rest.vertex_count(); v += 1 + v % 3) ids.push_back(v);
        const Region region(rest.shared_topology(), ids);
        BoundaryDeformation deformed;
        std::vector<double> scale(static_cast<std::size_t>(rest.vertex_count()), 1.0);
        for (const Index v : region.vertices()) {
            scale[v] = 0.5 + 0.1 * v;
            const Mat3 turn =
                Eigen::AngleAxisd(0.1 * v, Vec3(1, 2, 3).normalized()).toRotationMatrix();
            deformed.transforms.push_back(scale[v] * turn);
        }
        Mesh moved = rest;
        turn_directions(rest, region, deformed, moved);
        const Attribute& after = *moved.attributes().find("morph.1.position");
        for (Index i = 0; i < count; ++i) {
            const Index v = domain == Domain::vertex ? i : rest.topology().faces().vertices[i];
            double grown = 0.0, was = 0.0;
            for (std::size_t k = 0; k < 3; ++k) {
                grown += std::pow(after.at(i)[k], 2);
                was += std::pow(before.at(i)[k], 2);
            }
            CHECK(std::sqrt(grown) == doctest::Approx(scale[v] * std::sqrt(was)));
        }
    }
}
