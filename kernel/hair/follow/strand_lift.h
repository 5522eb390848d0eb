/// Strands that are kept out of the skin; private to kernel/hair.
#pragma once

#include <Eigen/Core>
#include <span>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/follow/head_motion.h"
#include "kernel/hair/follow/skin_contact.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// A strand with the lengths from its root to its points at rest.
struct LiftedStrand {
    StrandView rest;
    std::span<const float> arcs;
    Eigen::Map<Eigen::Matrix3Xf> made;
};

/// Returns the metres that a point stays off the skin at rest, at a length from its root: 0 there,
/// `clearance` from 10 mm on.
double clearance_at(double clearance, float arc);

class StrandLift {
  public:
    /// `clearance` is in metres at rest.
    StrandLift(const HeadMotion& head, double clearance) : head_(head), clearance_(clearance) {}

    /// Keeps all points, and the middles between them, out of the moved skin.
    void out_of(const SkinSurface& moved, const SkinSurface& rest, LiftedStrand strand) const;

  private:
    double floor_at(float arc) const;
    double rest_height(const SkinSurface& rest, const Vec3& point) const;
    template <typename Height>
    bool raise(LiftedStrand& strand, Index k, Vec3& point, double floor,
               const Height& height) const;
    template <typename Height>
    bool raise_middle(const LiftedStrand& strand, Index k, Vec3& point, const SkinSurface& rest,
                      const Height& height) const;

    const HeadMotion& head_;
    double clearance_;
};

}  // namespace lissom
