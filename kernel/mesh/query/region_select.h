/// Constructors of regions from geometry, labels and attributes. Each selects vertices; none is an
/// error when it selects nothing. All from a list of vertices, and none, are in region.h.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// Vertices within `radius` of `center`, in space.
/// Errors: invalid_argument unless the radius is finite and not negative; not_finite for the
/// center.
Region select_sphere(const Mesh& mesh, const Vec3& center, double radius);

/// Vertices inside an axis-aligned box, its sides included. Sides may be infinite. Errors:
/// invalid_argument if min exceeds max or is NaN.
Region select_box(const Mesh& mesh, const Box& box);

/// Vertices inside a box that is given in fractions of the mesh's bounds: 0 is the least coordinate
/// of an axis, 1 the greatest. Sides may be infinite. Errors: as select_box.
Region select_fraction(const Mesh& mesh, const Box& fractions);

/// Returns the part of a region that edges between its vertices connect with `vertex`. Errors:
/// out_of_range if it is not in the region.
Region connected_part(const Region& region, Index vertex);
/// Returns the same for the vertex of the region that is nearest to `point`. Errors: region_empty;
/// topology_mismatch; not_finite.
Region connected_part(const Mesh& mesh, const Region& region, const Vec3& point);

/// Vertices on the side of a plane that `normal` points to, the plane included.
/// Errors: invalid_argument for a normal without length; not_finite.
Region select_plane(const Mesh& mesh, const Vec3& point, const Vec3& normal);

/// Vertices within the distance `radius` over the surface of any of the vertices `from`, by the
/// heat method.
/// Errors: invalid_argument without sources or for a radius that is negative or NaN; out_of_range
/// naming the vertices; as HeatDistances.
Region select_geodesic(const Mesh& mesh, std::span<const Index> from, double radius,
                       const Context& context = {});

/// Returns the same from a point of the surface, which need not be a vertex.
Region select_around(const Mesh& mesh, const SurfacePoint& from, double radius,
                     const Context& context = {});

/// Vertices of the faces that carry `label` of the given kind ("group", "material", "object", ...).
/// Errors: invalid_argument naming the labels there are.
Region select_label(const Mesh& mesh, std::string_view kind, std::string_view label);
Region select_group(const Mesh& mesh, std::string_view group);
Region select_material(const Mesh& mesh, std::string_view material);

/// Vertices of one connected component, by number (ordered by smallest vertex).
/// Errors: out_of_range.
Region select_component(const Mesh& mesh, Index number);
/// Vertices of the component that contains `vertex`. Errors: out_of_range.
Region select_component_of(const Mesh& mesh, Index vertex);

/// Selects vertices with a value of the attribute `name` in [min, max]. The first number of a wide
/// attribute counts. A corner or face attribute selects the vertices of the corners or faces in
/// range. Errors: invalid_argument for an unknown name (naming those there are) or if min exceeds
/// max.
Region select_attribute(const Mesh& mesh, std::string_view name, double min, double max);

/// Vertices for which `predicate(vertex, position)` holds. It is called in ascending order, once
/// each.
Region select_where(const Mesh& mesh,
                    const std::function<bool(Index vertex, const Vec3& position)>& predicate);

}  // namespace lissom
