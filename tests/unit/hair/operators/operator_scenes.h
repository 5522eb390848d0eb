/// All operators that style strands, with options that let them do something.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "kernel/hair/operators/strand_bend.h"
#include "kernel/hair/operators/strand_collision.h"
#include "kernel/hair/operators/strand_curl.h"
#include "kernel/hair/operators/strand_detail.h"
#include "kernel/hair/operators/strand_frizz.h"
#include "kernel/hair/operators/strand_gather.h"
#include "tests/unit/hair/strands/strand_support.h"

namespace lissom::test {

struct NamedOperator {
    std::string name;
    std::function<void(Strands&, const StrandOperatorOptions&, const Context&)> run;
    /// Lengths stay with the options given.
    bool keeps_length = false;
};

/// Takes the shared options as its own.
template <typename Options>
Options with_effect(Options options, const StrandOperatorOptions& effect) {
    options.factor = effect.factor;
    options.mask = effect.mask;
    options.seed = effect.seed;
    return options;
}

/// Distance to a plane through all roots of random_hair.
inline double above_floor(const Vec3& p) {
    return p.y() - 0.005;
}

/// A strand that bends to and fro.
inline Strands zigzag() {
    std::vector<float> points;
    for (int k = 0; k < 40; ++k) {
        const float side = k == 0 ? 0.0f : 0.002f * float(k / 2 % 2);
        points.insert(points.end(), {side, 0.004f * float(k), 0.0f});
    }
    return {std::move(points), {0, 40}};
}

inline std::vector<NamedOperator> all_operators() {
    GatherOptions gathers;
    gathers.guides = 20;
    TwistOptions twists;
    twists.guides = 20;
    PinchOptions pinches;
    pinches.guides = 20;
    CurlOptions curls;
    curls.guides = 20;
    curls.radius = 0.004;
    curls.ramp = 0.01;
    CurlOptions free_curls = curls;
    free_curls.keep_length = false;
    CurlOptions waves = wave_options();
    waves.guides = 20;
    waves.start = waves.ramp = 0.01;
    waves.points_per_turn = 0;
    RotateOptions rotates;
    rotates.axis = Vec3(1, 0, 0);
    rotates.angle = 0.4;
    rotates.variation = 0.1;
    DisplaceOptions displaces;
    displaces.offset = {0.01, 0.02, 0};
    LengthOptions lengths;
    lengths.scale = 1.3;
    lengths.variation = 0.2;
    PushOutOptions pushes;
    pushes.distance = above_floor;
    ShrinkwrapOptions wraps;
    wraps.distance = above_floor;
    const auto give_details = [](Strands& s, const DetailOptions& options, const Context& c) {
        add_detail(s, zigzag(), options, c);
    };
    using Effect = StrandOperatorOptions;
    const auto make = [](const std::string& name, const auto& function, const auto& options,
                         bool keeps) {
        return NamedOperator{name,
                             [=](Strands& s, const Effect& e, const Context& c) {
                                 function(s, with_effect(options, e), c);
                             },
                             keeps};
    };
    return {make("gather", gather, gathers, false),
            make("twist", twist, twists, false),
            make("pinch", pinch, pinches, false),
            make("curl", curl, curls, true),
            make("curl that lengthens", curl, free_curls, false),
            make("wave", curl, waves, true),
            make("detail", give_details, DetailOptions(), true),
            make("frizz", frizz, FrizzOptions(), true),
            make("straighten", straighten, StrandOperatorOptions(), true),
            make("rotate", rotate, rotates, true),
            make("roll", roll, RollOptions(), true),
            make("puff", puff, PuffOptions(), true),
            make("displace", displace, displaces, true),
            make("set_length", set_length, lengths, false),
            make("push_out", push_out, pushes, false),
            make("shrinkwrap", shrinkwrap, wraps, true)};
}

}  // namespace lissom::test
