/// Mirror images of handles, and other changes of a Deformer's constraints.
#pragma once

#include "kernel/core/geometry.h"
#include "kernel/deform/deformer.h"
#include "kernel/deform/options.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// Adds the mirror image of a handle: a second handle with the same options, whose transform is
/// always the mirrored one; moving either moves both. It holds the vertices nearest to the
/// reflected ones and those whose own reflection lies on the handle, so that both sides may be
/// tessellated differently; on a symmetric mesh the result is symmetric. Vertices on its rim
/// that are no exact counterparts are left to other handles. Errors: invalid_argument if the
/// region has no surface within a quarter of its radius of half of the image, naming the
/// vertices, or if the handle has an image already; handle_overlap if the handle reaches the
/// plane, or others hold the image; handle_removed.
HandleId mirror_handle(Deformer& deformer, HandleId handle, const MirrorPlane& plane);
/// Measures how well both sides of the rest shape match if a handle has a mirror image.
/// Errors: handle_removed; invalid_argument for a handle without one.
MirrorResidual mirror_residual_of(const Deformer& deformer, HandleId handle);

/// Gives a handle other vertices, and no points; its transform stays, and a mirrored handle
/// follows. The result stays as it is until the next solve, which refactors.
/// Errors: as Deformer::add_handle and mirror_handle; handle_removed.
void set_handle_region(Deformer& deformer, HandleId handle, const Region& vertices);
/// Sets the resistance of the surface at `vertices` to bending and stretching, beside 1 for the
/// rest: stiff parts move rigidly, and soft ones take the bend. Refactors.
/// Errors: topology_mismatch; handle_outside_region; invalid_argument for a factor that is not
/// from 1e-4 to 1e5: nothing softer or stiffer can be seen, but the systems lose digits.
void set_stiffness(Deformer& deformer, const Region& vertices, double factor);
/// Sets the share of the volume that solves keep, from 0 to 1; see DeformOptions::volume. Refactors
/// nothing, but finds the thickness of the region the first time. Errors: invalid_argument for a
/// share out of range; unsupported for a comparison method.
void keep_volume(Deformer& deformer, double share);
/// Returns that share.
double kept_volume(const Deformer& deformer);
/// Returns the map f by which a handle takes p to about + f(p - about), to compose moves with.
Affine transform_about(const Deformer& deformer, HandleId handle, const Vec3& about);

}  // namespace lissom
