/// Guides: the strands that others gather around, and the nearest of them.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/strands/strands.h"

namespace lissom {

/// Place of a strand among others: its root, and how far the middle of its length lies from the
/// root, so that neighbours that are combed to different sides of a parting are far apart.
using GuideKey = Eigen::Matrix<double, 6, 1>;

/// Returns the key of a finite strand; `apart` weighs the second part.
GuideKey guide_key(const StrandView& strand, double apart);

/// A tree of keys that finds the nearest.
class GuideTree {
  public:
    explicit GuideTree(std::vector<GuideKey> keys);

    /// Returns the number of the key nearest to `key`; the first of ties. kNoIndex if there are
    /// none.
    Index nearest(const GuideKey& key) const;

  private:
    struct Best {
        double distance;
        Index guide;
    };

    void build(Index begin, Index end, int axis);
    void search(const GuideKey& key, Index begin, Index end, int axis, Best& best) const;

    std::vector<GuideKey> keys_;
    /// Numbers of keys; the middle of a range splits the rest of it along one axis after the other.
    std::vector<Index> order_;
};

/// Choice of guides.
struct GuideOptions {
    /// Number of guides: the strands of the lowest ids that are finite and have more than a root.
    /// These are spread over the scalp, so any part of the hair that has them gathers as the whole
    /// does. At least 1.
    Index count = 400;
    /// The nearest guide counts; its distance includes that of the combed middles of the strands,
    /// times this: a strand follows one of its own side of a parting. 0 or more.
    double apart = 0.5;
    /// Strands rooted further than this from their guide follow none; positive.
    double radius = std::numeric_limits<double>::infinity();
    /// Strands follow guides of their own group only.
    bool within_groups = true;
};

/// Returns the strand that each strand follows, itself for a guide; kNoIndex for none, as for
/// strands that are not finite. Errors: invalid_argument for options out of range; cancelled.
std::vector<Index> nearest_guides(const Strands& strands, const GuideOptions& options,
                                  const Context& context = {});

/// Returns the strand that each strand follows by Strands::guides; kNoIndex for none, or one that
/// is not there.
std::vector<Index> present_guides(const Strands& strands);

/// Lets strands follow the nearest guides from now on: sets Strands::guides. The arcs are the
/// lengths of the strands, at most that of their guide. Errors: as nearest_guides; memory_limit.
void assign_guides(Strands& strands, const GuideOptions& options = {}, const Context& context = {});

/// A strand with a frame at each of its points that turns about it as little as possible.
class GuideCurve {
  public:
    /// `strand` must be finite.
    explicit GuideCurve(const StrandView& strand);

    /// A point of the curve, with the normal, the binormal and the tangent there in the columns of
    /// its frame, the mean of those of the points around it; at the root the normal is arbitrary.
    struct Point {
        Vec3 position;
        Mat3 frame;
    };
    /// At arc length fraction `t`.
    Point at(double t) const;

  private:
    std::vector<double> t_;
    std::vector<Vec3> points_;
    std::vector<Mat3> frames_;
};

}  // namespace lissom
