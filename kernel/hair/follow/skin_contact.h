/// Contact of moved hair with the skin; private to kernel/hair.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/follow/head_motion.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Height of a point over the skin below it, and the unit normal there.
struct SkinHeight {
    double height = 0.0;
    Vec3 normal = Vec3::Zero();
};

/// Heights over a head of triangles in one shape, negative inside, by its nearest places.
class SkinSurface {
  public:
    /// `sign` is -1 for faces that look inward.
    SkinSurface(std::vector<Vec3> places, const Triangulation& triangles, const Topology& topology,
                double sign, const Context& context);

    /// Returns the height if the skin is within `reach`; nothing beyond an open edge of it.
    std::optional<SkinHeight> height(const Vec3& point, double reach) const;
    /// Returns the nearest place within `reach`.
    std::optional<SurfacePoint> nearest(const Vec3& point, double reach) const;

  private:
    bool is_open(const SurfacePoint& foot) const;

    const Topology& topology_;
    std::vector<Vec3> normals_;
    double sign_;
    SpatialTree tree_;
};

/// Points that lie near the skin at rest, with the places of it below them.
class SkinBinding {
  public:
    struct SkinPlace {
        Index point = 0;
        std::uint32_t vertices[3] = {};
        float weights[3] = {};
        /// Height at rest.
        float height = 0.0f;
    };

    SkinBinding() = default;
    /// Binds points less than `reach` over `skin`, which is at rest.
    SkinBinding(const Strands& strands, const SkinSurface& skin, const HeadMotion& head,
                double reach, const Context& context);

    /// Returns the places of the points of a strand, in their order along it.
    std::span<const SkinPlace> of(Index strand) const {
        if (first_.empty()) return {};
        return std::span(places_).subspan(first_[at(strand)],
                                          first_[at(strand) + 1] - first_[at(strand)]);
    }
    /// Returns the height of a point over the place, as `head` is now, and the same to about 1e-6
    /// metres.
    static SkinHeight height(const SkinPlace& place, const Vec3& point, const HeadMotion& head);
    static float quick_height(const SkinPlace& place, const float* point, const HeadMotion& head);
    std::size_t memory_bytes() const {
        return first_.size() * sizeof(std::size_t) + places_.size() * sizeof(SkinPlace);
    }

  private:
    std::vector<std::size_t> first_;
    std::vector<SkinPlace> places_;
    MemoryCharge charge_;
};

}  // namespace lissom
