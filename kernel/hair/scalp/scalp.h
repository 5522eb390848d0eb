/// Scalp: the skin of a head with hair, and the frame that makes hairstyles fit any head.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/scalp/head_frame.h"
#include "kernel/hair/scalp/skull_over_ears.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/region.h"
#include "kernel/mesh/shapes/hairline.h"

namespace lissom {

struct ScalpOptions {
    /// Directions of the head in the mesh; guessed if absent (head_frame.h).
    HeadHints hints;
    /// Metres in one unit of the mesh; guessed if absent.
    std::optional<double> unit = std::nullopt;
    /// Skin with hair. If absent it is the mesh's region "scalp", and without one the skin above
    /// the hairline, except the ears.
    std::optional<Region> region = std::nullopt;
    /// Edge of the hair by ascending azimuths in [0, pi], radians; smooth between the points.
    std::vector<HairlinePoint> hairline = default_hairline();
    /// Width of the band over which hair thins out at the hairline, in metres of the scalp's frame;
    /// 0 to 0.1.
    double softness = 0.011;
};

/// A point of the head as styles name it.
struct ScalpPoint {
    Vec3 position = Vec3::Zero();
    /// Outward unit normal, interpolated from those of the vertices.
    Vec3 normal = Vec3::Zero();
    /// The point of the head under it.
    SurfacePoint on_head;
};

/// Directions from the center of the frame, radians.
struct ScalpDirection {
    /// 0 in front, pi / 2 at the head's left (+x), pi at the back; in (-pi, pi].
    double azimuth = 0.0;
    /// 0 is horizontal, pi / 2 up.
    double elevation = 0.0;
};

class Scalp {
  public:
    /// Takes the present shape of `head`, which may change or die afterwards. Errors: as
    /// guess_head_frame; topology_mismatch for a region of another mesh; region_empty if it holds
    /// no face; invalid_argument for a unit, softness or hairline out of range; memory_limit;
    /// cancelled.
    explicit Scalp(const Mesh& head, const ScalpOptions& options = {}, const Context& context = {});

    /// Returns the options it was made with.
    const ScalpOptions& options() const { return options_; }
    const HeadFrame& frame() const { return frame_; }
    /// Mesh units in one metre of the scalp's frame: the head's width over that of an average head
    /// (0.155 m). Styles made in metres fit every head.
    double scale() const { return scale_; }
    /// Returns the metres in one unit of the mesh: as given, or the usual unit (metre, centimetre,
    /// millimetre, decimetre or inch) that makes this the width of a person's head, or, if none
    /// does, 1 / scale(), with which it is an average head.
    double unit() const { return unit_; }
    /// Returns false if no usual unit makes this a person's head, as for a model scaled to some
    /// size.
    bool knows_unit() const { return knows_unit_; }
    /// Returns how sure the frame is, 0 to 1: as HeadFrame::confidence. If it is below 0.5 and
    /// something was guessed, making the scalp logs a warning.
    double confidence() const { return frame_.confidence; }
    /// Returns whether the region was guessed from the hairline.
    bool guessed() const { return guessed_; }
    const Region& region() const { return region_; }
    const SpatialTree& tree() const { return tree_; }

    /// Faces that roots may lie on, ascending: those of a given region; of a guessed one all that
    /// reach into it.
    const std::vector<Index>& root_faces() const { return root_faces_; }
    /// Returns how far each vertex is inside the hairline in units of the softness: hair grows with
    /// the probability smoothstep(0, 1, margin). At least -1000, at most 1000.
    const std::vector<double>& margins() const { return margins_; }
    /// Returns the same at a point of the surface: for a guessed region that of the hairline
    /// itself, for any size of the faces.
    double margin_at(const Triangle& triangle, const Vec3& barycentric, const Vec3& position) const;

    /// Exit point of the ray from the center in a direction, offset by `lift` metres (of the frame)
    /// along the normal there. Errors: not_finite; out_of_range if the head has no surface in that
    /// direction.
    ScalpPoint at(const ScalpDirection& direction, double lift = 0.0) const;
    /// Exit point of the ray from the center; nothing if it never leaves the head.
    std::optional<SurfacePoint> surface_in(const ScalpDirection& direction) const;
    /// Direction of a point of the mesh from the center.
    ScalpDirection direction_of(const Vec3& point) const;
    /// Unit vector in the mesh.
    Vec3 vector_of(const ScalpDirection& direction) const;

    /// Returns a point given in metres of the frame from the center (x to the head's left, y up, z
    /// to the front), in the mesh; and back.
    Vec3 from_metres(const Vec3& metres) const { return frame_.world(scale_ * metres); }
    Vec3 to_metres(const Vec3& point) const { return frame_.local(point) / scale_; }
    /// Unit normal at a point of the surface, interpolated from those of the vertices.
    Vec3 normal_at(const Triangle& triangle, const Vec3& barycentric) const;

    /// `default_volume` in the mesh, in a box along the axes of the mesh: around the head with
    /// room for volume on all sides, and below it for hair to the shoulders. In the middle of the
    /// head across.
    Box default_box() const;

    /// Returns the default volume of a hairstyle in metres of the frame: around the head with room
    /// for volume on all sides, and below it for hair to the shoulders.
    static Box default_volume() { return {{-0.2, -0.42, -0.24}, {0.2, 0.22, 0.22}}; }

  private:
    void choose_region(const Mesh& head, const ScalpOptions& options);
    void set_given_region(const Mesh& head, const Region& region, double softness);
    void guess_region(const Mesh& head);
    bool faces_outward(const Triangle& triangle, const Vec3& barycentric,
                       const Vec3& position) const;

    ScalpOptions options_;
    HeadFrame frame_;
    double scale_ = 1.0, unit_ = 1.0;
    bool guessed_ = false, knows_unit_ = true;
    std::vector<HairlinePoint> hairline_;
    double softness_ = 0.0;
    SkullOverEars skull_;
    Region region_;
    std::vector<Index> root_faces_;
    std::vector<double> margins_;
    std::vector<Vec3> normals_;
    SpatialTree tree_;
    MemoryCharge charge_;
};

}  // namespace lissom
