/// A head with hair to grow, shared by the tests of growth.
#pragma once

#include <vector>

#include "kernel/hair/curve/curve.h"
#include "kernel/hair/curve/stream_curve.h"
#include "kernel/hair/growth/growth.h"
#include "kernel/mesh/shapes/head.h"
#include "tests/unit/hair/hair_support.h"

namespace lissom::test {

/// The generated head with hair that is swept over its top by three streams.
struct Groomed {
    Mesh head = make_head({.vertices = 3000});
    Scalp scalp{head};
    HairField field{DistanceGrid(head, fit_grid(scalp.default_box(), 12000))};
    std::vector<Root> roots = make_roots(head, scalp, {.count = 1500});

    Groomed() {
        for (const double side : {-0.6, 0.0, 0.6}) {
            std::vector<Vec3> points;
            for (const double back : {0.3, 1.2, 2.2, 2.8}) {
                const double elevation = 1.2 - 0.35 * back;
                const double azimuth = side * (1.0 - back / 3.5) + (side < 0.0 ? -back : back);
                points.push_back(scalp.at({azimuth, elevation}, 0.01).position);
            }
            std::vector<Vec3> curve = smooth_curve(points, 0.2 * field.layout().step);
            push_out(curve, field.distances(), 0.004);
            curve = resampled_curve(curve, field.layout().step);
            field.set_constraints(++curves, stream_constraints(field.layout(), curve, {0.04}));
        }
        field.solve();
    }

    Strands grown(const GrowthOptions& options = {}, const Context& context = {}) const {
        Strands strands;
        grow(head, field, roots, options, strands, context);
        return strands;
    }

    int curves = 0;
};

inline const Groomed& groomed() {
    static const Groomed scene;
    return scene;
}

inline std::vector<float> points_of(const Strands& strands) {
    return {strands.points().begin(), strands.points().end()};
}

}  // namespace lissom::test
