/// A part that stands on sharp edges of its target: it keeps its shape, and its foot is drawn down
/// to the surface; private to kernel/merge.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/merge/paste/part/moving_part.h"
#include "kernel/merge/paste/part/paste_part.h"
#include "kernel/merge/paste/search/paste_energy.h"

namespace lissom {

/// The motion of space that stands a part on a surface and draws its foot down to that: a
/// similarity x -> S(x), then S(x) + w d. The vector d leads along the part's axis from the disk
/// that the boundary spans to the surface, smoothed the more the higher x lies, so that edges of
/// the surface go on in the foot; w falls from 1 at the height of the boundary to 0 at that of the
/// tip. The part stands where its boundary first touches the surface, so that d points down and the
/// part is only stretched.
class Drape {
  public:
    /// Returns the point at which a line along the axis through a point meets the surface.
    using Ground = std::function<std::optional<Vec3>(const Vec3& point, const Vec3& axis)>;

    /// `images` are the places of the part's loop on the surface, in its order. `ground` has what
    /// lies under the part; if it has nothing there, the boundary is extended harmonically.
    Drape(const PastePart& part, std::span<const Vec3> images, const PasteSimilarity& similarity,
          double scale, Ground ground = {});

    /// The direction that the part stands in, of unit length.
    const Vec3& axis() const { return axis_; }
    /// Mean distance of the images from their mean.
    double radius() const { return radius_; }
    /// Returns the longest way that the boundary is drawn.
    double depth() const;
    /// Returns the height of a point of the source over the boundary; that of the tip.
    double height_at(const Vec3& point) const { return foot_at(stood(point)).height; }
    double tip() const { return tip_; }
    /// The place of a point of the source before it is drawn.
    Vec3 stood(const Vec3& point) const;
    /// Moves the part; its loop comes to lie on the images.
    MovedPart moved(const Context& context) const;

  private:
    struct Foot {
        Vec3 draw = Vec3::Zero();
        double height = 0.0;
    };
    Foot foot_at(const Vec3& stood) const;
    double sunk(const Vec3& on_disk) const;
    double sunk_around(const Vec3& on_disk, double radius) const;
    Vec3 drawn(const Vec3& point) const;
    Mat3 gradient_at(const Vec3& point, double step) const;
    void raise(double height, std::span<const Vec3> images);
    void stand(std::span<const Vec3> images);
    void clear_ground();
    void measure_heights();
    double cut_by(const Vec3& from, const Vec3& to) const;
    void lift(std::vector<Vec3>& positions, const Context& context) const;

    const PastePart& part_;
    PasteSimilarity similarity_;
    double scale_ = 1.0, radius_ = 0.0;
    // Of the boundary on the source and on the surface; the latter is moved along the axis.
    Vec3 from_ = Vec3::Zero(), to_ = Vec3::Zero(), axis_ = Vec3::Zero();
    // The farthest from the boundary's height: above 0 for a part that stands out.
    double tip_ = 0.0;
    // The boundary as it stands, what it lacks to its images beyond the ground, these, and the
    // length that each stands for.
    std::vector<Vec3> rim_, lack_, images_;
    std::vector<double> length_;
    Ground ground_;
};

/// Returns the height of each vertex of a part over its boundary, harmonically continued, along the
/// axis: above 0 on the side that stands out most.
std::vector<double> heights_over_boundary(const PastePart& part);

/// Returns the direction of unit length that a part's boundary runs around counter-clockwise.
Vec3 loop_axis(const PastePart& part);

}  // namespace lissom
