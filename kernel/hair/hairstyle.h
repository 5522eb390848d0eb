/// Hairstyle: style curves on a head, the direction field that they determine, and the hair that
/// follows it (thesis, chapter 4).
///
///     Hairstyle style(head);
///     style.add(StreamCurve{.points = points});
///     const Strands hair = style.grow();
///
/// Points, lengths and directions are in metres of the scalp's frame (Scalp::to_metres): x to the
/// head's left, y up, z to the front. So a style that was made for one head fits another.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/curve/constraint_kind.h"
#include "kernel/hair/curve/fidelity.h"
#include "kernel/hair/curve/style_curve.h"
#include "kernel/hair/curve/tilt_fit.h"
#include "kernel/hair/field/grid_layout.h"
#include "kernel/hair/field/hair_field.h"
#include "kernel/hair/field/scalp_step.h"
#include "kernel/hair/growth/growth.h"
#include "kernel/hair/scalp/mask_stroke.h"
#include "kernel/hair/scalp/roots.h"
#include "kernel/hair/scalp/scalp.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/hair/style_inputs.h"
#include "kernel/mesh/mesh.h"
#include "kernel/solve/grid/grid_field_options.h"

namespace lissom {

struct HairstyleOptions {
    /// Points of the grid that the field lives on, at most. The thesis takes 25,000 for smooth
    /// styles and 50,000 for complex ones (section 4.6).
    Index resolution = 50000;
    /// Box that hair may fill; strands end at its faces. Absent: Scalp::default_volume.
    std::optional<Box> volume = std::nullopt;
    GridFieldOptions field = HairField::default_options();
    /// Hair that no curve is near falls along the head, goes to the sides over the face, and to the
    /// nearest tie if there are ponytails; a stream that ends close to a tie leads into it, and
    /// from the end of any other hair falls on. 0 to 1; 0 for the field of the curves alone,
    /// as in the thesis.
    double gravity = 1.0;
    /// Defaults of curves, for scripts and style files, and of hair
    /// (Hairstyle::default_hair).
    HairFidelity fidelity = HairFidelity::lissom;
};

/// Returns the default options of a fidelity. The thesis has the Laplacian's weights of section
/// 4.4.1 at the faces of the grid, no tension and no gravity.
HairstyleOptions style_options_with(HairFidelity fidelity);

/// Returns the default options of growth of a fidelity. In section 4.6 of the thesis strands follow
/// the field alone, l v(p) a segment, even into the head, with any turn and any length, and do not
/// vary in length.
GrowthOptions growth_options_with(HairFidelity fidelity);

/// A vector that the style gives the field at a grid point.
struct StyleConstraint {
    Vec3 point = Vec3::Zero(), vector = Vec3::Zero();
    ConstraintKind kind = ConstraintKind::stream;
    /// The curve that counts there; none for those of avoid_scalp.
    std::optional<CurveId> curve = std::nullopt;
    /// omega of equation (4.2).
    double weight = 0.0;
};

/// Options of growth.
struct HairOptions {
    RootOptions roots = {};
    /// The style sets `placement` and `ties`.
    GrowthOptions growth = {};
};

/// If curves claim a grid point differently, dividing curves count before the others; among equals
/// the curve that is later in the order counts, together with those that agree with it within 60
/// degrees (curve_conflicts.h).
///
/// A hairstyle is its inputs; field, roots and strands follow from them, and results are reused if
/// their own inputs are the same. After an error the inputs are as they were.
class Hairstyle {
  public:
    /// Takes the present shape of `head`, which may change or die afterwards; `scalp` must have
    /// been made for it. Errors: invalid_argument for a volume or resolution out of range;
    /// topology_mismatch; mesh_empty; memory_limit, before anything is computed if the grid needs
    /// more memory than the limit of the context, or without one than the machine has; cancelled.
    Hairstyle(const Mesh& head, std::shared_ptr<const Scalp> scalp,
              const HairstyleOptions& options = {}, const Context& context = {});
    /// The same with the scalp that Scalp finds on the head. Errors: as before, and as Scalp.
    explicit Hairstyle(const Mesh& head, const HairstyleOptions& options = {},
                       const Context& context = {});
    ~Hairstyle();
    Hairstyle(Hairstyle&&) noexcept;
    Hairstyle& operator=(Hairstyle&&) noexcept;

    const Scalp& scalp() const;
    const std::shared_ptr<const Scalp>& shared_scalp() const;
    const HairstyleOptions& options() const;
    /// Returns the head in metres of the frame.
    const Mesh& head() const;
    const GridLayout& layout() const;
    /// Signed distance to the surface of the head itself, negative inside; far away that of the
    /// field. Thread-safe.
    double surface_distance(const Vec3& point) const;

    /// Adds a curve behind all others. Errors: as set.
    CurveId add(StyleCurve curve);
    /// The same for a curve that has no name.
    CurveId add(StreamCurve curve);
    CurveId add(DividingCurve curve);
    CurveId add(Ponytail curve);
    /// Adds curves behind all others in this order, all or none, and faster than one by one.
    /// Errors: as set, naming the curve by its number in `curves`, from 1; cancelled.
    std::vector<CurveId> add_all(std::vector<StyleCurve> curves, const Context& context = {});
    /// Replaces a curve. After an error nothing has changed. Errors: handle_removed for an id;
    /// not_finite; invalid_argument if fewer than two points differ, or for an option out of range;
    /// out_of_range for a curve outside the volume, or a dividing curve off the head; memory_limit.
    void set(CurveId id, StyleCurve curve);
    /// Errors of the following: handle_removed for an id.
    void set_points(CurveId id, std::vector<Vec3> points);
    void enable(CurveId id, bool on);
    void remove(CurveId id);
    /// Gives a curve the place `place` in the order, from 0. Errors: also out_of_range.
    void reorder(CurveId id, Index place);
    /// In their order.
    std::span<const CurveId> curves() const;
    bool has(CurveId id) const;
    const StyleCurve& curve(CurveId id) const;
    /// Returns the curve as it acts: smooth, outside the head, in segments of about a grid step.
    const std::vector<Vec3>& course(CurveId id) const;
    /// Returns the tilts by which a dividing curve acts. Errors: also invalid_argument for another
    /// kind of curve.
    const TiltFit& tilt(CurveId id) const;
    /// Adds a hint stroke, a polyline beside a dividing curve along which hair flows away from it
    /// (DividingCurve::hints). Errors: as tilt and set; out_of_range if no part of the hint is
    /// beside the curve.
    void add_hint(CurveId id, std::vector<Vec3> hint);
    /// Returns the circle of hair around the beginning of a ponytail. Errors: as tilt.
    const HairTie& tie(CurveId id) const;
    /// Returns the constraints of the curves that are enabled and of avoid_scalp, one a grid point,
    /// in the order of the grid's points.
    std::vector<StyleConstraint> constraints() const;

    /// Returns the strokes painted on the scalp, in their order: its hair grows with the lengths
    /// and the density of these, besides those of HairOptions.
    std::span<const MaskStroke> masks() const;
    /// Paints a stroke over the others. Errors: as require_mask.
    void add_mask(MaskStroke stroke);
    /// Removes the strokes of one kind.
    void clear_masks(MaskKind kind);

    /// Returns all that the style is made of: a copy given to `restore` later is an undo.
    const StyleInputs& inputs() const;
    /// Takes the inputs of a style on this head with the same options. Ids are not given again.
    /// Errors: as set, for every curve; invalid_argument for ids that are not distinct, or a scalp
    /// step of another grid.
    void restore(StyleInputs inputs);

    /// Brings the field up to date with the curves; does nothing if none has changed. Without
    /// curves it is zero. After an error the field is that of the last solve. Errors: as
    /// HairField::solve.
    void solve(const Context& context = {});
    bool solved() const;
    /// Returns the field of the last solve.
    const HairField& field() const;

    /// Turns the field along the head if it points into it, by constraints at all grid points near
    /// the head that no curve constrains (section 4.6). To be done once, when the curves are as
    /// wanted: the constraints stay as they are until it is called again. Solves. Over the scalp
    /// all such points count, on the rest of the head only those with an inward field, besides the
    /// limits of `options`. After an error the constraints are as they were, and the field is that
    /// of the last solve. Errors: as scalp_step and solve.
    void avoid_scalp(const ScalpStepOptions& options = {}, const Context& context = {});
    /// Removes the constraints of `avoid_scalp`.
    void forget_scalp();
    bool avoids_scalp() const;

    /// Returns the default options of its fidelity. In the thesis roots lie in steps of angles, and
    /// strands are as long as the field carries them.
    HairOptions default_hair() const;
    /// Grows hair into `strands`, whose memory is used again; solves first if needed. Groups are
    /// named after the ponytails through whose tie strands pass. The first n strands of a larger
    /// count are those of count n. After an error `strands` are as they were, or empty if growth
    /// itself had begun: it reuses their memory. Errors: invalid_argument without an enabled curve;
    /// as make_roots, grow and solve.
    GrowthReport grow(const HairOptions& options, Strands& strands, const Context& context = {});
    Strands grow(const HairOptions& options, const Context& context = {});
    /// Returns the default hair of its fidelity.
    Strands grow();

    /// Bytes of grids, head and factors, about.
    std::size_t memory_bytes() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lissom
