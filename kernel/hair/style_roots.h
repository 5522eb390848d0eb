/// Roots of a hairstyle, but for those on bare skin; private to kernel/hair.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/derived_style.h"
#include "kernel/hair/growth/growth.h"
#include "kernel/hair/scalp/roots.h"
#include "kernel/hair/scalp/scalp.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Returns the roots of make_roots, without those for which `bare(root)` is true, if it is given;
/// the first n of a larger count are those of count n. Errors: as make_roots; region_empty if all
/// skin is bare.
std::vector<Root> roots_but_for(const Mesh& head, const Scalp& scalp, const RootOptions& options,
                                const std::function<bool(const Root&)>& bare,
                                const Context& context);

/// Inputs of the roots of a hairstyle, besides its head.
struct RootKey {
    /// Bare skin along a dividing curve.
    struct Gap {
        std::vector<Vec3> course;
        double width = 0.0;

        bool operator==(const Gap&) const = default;
    };

    RootOptions options;
    std::vector<Gap> gaps;

    bool operator==(const RootKey&) const = default;
};

/// Roots ready to grow from.
struct StyleRoots {
    RootKey key;
    std::vector<Eigen::Vector2f> uvs;
    StrandGrower grower;
};

/// The head as its mesh has it, and in metres of the frame.
struct HeadShapes {
    const Mesh& original;
    const Mesh& placed;
    const Scalp& scalp;
};

/// Makes `roots` those of `options` and of the partings of `style`; keeps them if they already are.
/// After an error there are none. Errors: as roots_but_for.
void update_roots(std::optional<StyleRoots>& roots, const HeadShapes& head,
                  const RootOptions& options, const DerivedStyle& style, const Context& context);

}  // namespace lissom
