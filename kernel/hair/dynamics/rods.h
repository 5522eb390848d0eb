/// Rods: chains of points that keep their lengths and resist bending; private to kernel/hair.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/dynamics/hair_rig.h"

namespace lissom {

class RodSystem;

/// A step of rods in time.
struct RodStep {
    double seconds = 0.0;
    /// Length as of HairDynamicsOptions.
    double stiffness = 0.0;
    /// Place of the head at its end.
    Affine head;
    /// Places of all points at its beginning.
    std::span<const Vec3> before;
};

/// The rods of a rig. Their density is 1 a metre; the first two points of each, and those in ties,
/// are held by the head.
class Rods {
  public:
    explicit Rods(const HairRig& rig);

    Index count() const { return count_; }
    /// Points of each rod.
    Index points() const { return points_; }
    const std::vector<Vec3>& rest() const { return rest_; }
    bool held(Index point) const { return inverse_masses_[at(point)] == 0.0; }

    /// Puts held points of a rod where `head` takes them.
    void hold(std::span<Vec3> places, const Affine& head, Index rod) const;
    /// Bends a rod from the places that its points would have without that towards its shape at
    /// rest.
    void bend(std::span<Vec3> places, const RodStep& step, Index rod) const;
    /// Gives the segments of a rod their lengths, by Newton's method.
    void keep_lengths(std::span<Vec3> places, Index rod) const;
    std::size_t memory_bytes() const;

  private:
    // The direction of the next segment, and the frame there, as seen from a segment's frame.
    struct Bend {
        Vec3 next = Vec3::UnitZ();
        Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    };

    // Of the segment behind a point: where its rod would have it, and where it is.
    struct Directions {
        Vec3 target, next;
    };
    // A point, and the first of its rod.
    struct Place {
        std::size_t point = 0, first = 0;
    };

    void prepare_bends(Index rod);
    void prepare_masses(Index rod);
    void add_bend(std::span<const Vec3> places, const Directions& now, const RodStep& step,
                  const Place& here, RodSystem& system) const;
    double correct_lengths(std::span<Vec3> places, Index rod) const;

    Index count_ = 0, points_ = 0;
    std::vector<Vec3> rest_;
    std::vector<double> lengths_;
    std::vector<Eigen::Quaterniond> root_frames_;
    std::vector<Bend> bends_;
    std::vector<double> inverse_masses_;
};

}  // namespace lissom
