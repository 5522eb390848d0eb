// Regions: sets of vertices of a mesh.
#include "kernel/mesh/region.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "bindings/c/data.h"
#include "kernel/mesh/query/region_select.h"

namespace lissom::c {
namespace {

void add_region(lissom_context& context, Region region, lissom_region* result) {
    require_given(result, "region");
    result->id = context.add(Kind::region, std::make_shared<Region>(std::move(region)));
}

Index nearest_vertex(const Mesh& mesh, const Vec3& point) {
    const auto positions = mesh.positions();
    require(!positions.empty(), "the mesh has no vertices", ErrorCode::mesh_empty);
    const auto nearest =
        std::min_element(positions.begin(), positions.end(), [&](const Vec3& a, const Vec3& b) {
            return (a - point).squaredNorm() < (b - point).squaredNorm();
        });
    return index_of(nearest - positions.begin());
}

Box box_of(const lissom_context& context, const double least[3], const double greatest[3]) {
    for (int k = 0; k < 3; ++k) {
        require(least[k] <= greatest[k], "least exceeds greatest, or is no number");
    }
    Box box;
    box.extend(context.space.to_kernel(least));
    box.extend(context.space.to_kernel(greatest));
    return box;
}

Region combined(const Region& a, const Region& b, lissom_region_operation operation) {
    switch (operation) {
        case LISSOM_UNION:
            return a.united(b);
        case LISSOM_INTERSECTION:
            return a.intersected(b);
        case LISSOM_DIFFERENCE:
            return a.minus(b);
    }
    throw Error(ErrorCode::invalid_argument, "there is no such operation of regions");
}

}  // namespace
}  // namespace lissom::c

using namespace lissom;
using namespace lissom::c;

extern "C" {

lissom_status lissom_region_all(lissom_context* context, lissom_mesh mesh, lissom_region* region) {
    return run(context, [&] {
        add_region(*context, Region::all(mesh_of(*context, mesh).shared_topology()), region);
    });
}

lissom_status lissom_region_of_vertices(lissom_context* context, lissom_mesh mesh,
                                        const lissom_input* vertices, lissom_region* region) {
    return run(context, [&] {
        add_region(
            *context,
            Region(mesh_of(*context, mesh).shared_topology(), read_any_ids(vertices, "vertices")),
            region);
    });
}

lissom_status lissom_region_sphere(lissom_context* context, lissom_mesh mesh,
                                   const double center[3], double radius, lissom_region* region) {
    return run(context, [&] {
        require_given(center, "center");
        add_region(*context,
                   select_sphere(mesh_of(*context, mesh), context->space.to_kernel(center), radius),
                   region);
    });
}

lissom_status lissom_region_box(lissom_context* context, lissom_mesh mesh, const double least[3],
                                const double greatest[3], lissom_region* region) {
    return run(context, [&] {
        require_given(least, "least");
        require_given(greatest, "greatest");
        add_region(*context, select_box(mesh_of(*context, mesh), box_of(*context, least, greatest)),
                   region);
    });
}

lissom_status lissom_region_plane(lissom_context* context, lissom_mesh mesh, const double point[3],
                                  const double normal[3], lissom_region* region) {
    return run(context, [&] {
        require_given(point, "point");
        require_given(normal, "normal");
        add_region(*context,
                   select_plane(mesh_of(*context, mesh), context->space.to_kernel(point),
                                context->space.to_kernel(normal)),
                   region);
    });
}

lissom_status lissom_region_geodesic(lissom_context* context, lissom_mesh mesh,
                                     const double point[3], double radius, lissom_region* region) {
    return run(context, [&] {
        require_given(point, "point");
        const Mesh& own = mesh_of(*context, mesh);
        const Index from = nearest_vertex(own, context->space.to_kernel(point));
        add_region(*context, select_geodesic(own, std::span(&from, 1), radius, context->kernel),
                   region);
    });
}

lissom_status lissom_region_named(lissom_context* context, lissom_mesh mesh, const char* name,
                                  lissom_region* region) {
    return run(context, [&] {
        const std::string text = given_text(name, "name");
        const Region* found = mesh_of(*context, mesh).find_region(text);
        if (!found) throw Error(ErrorCode::out_of_range, "the mesh has no region '" + text + "'");
        add_region(*context, *found, region);
    });
}

lissom_status lissom_mesh_set_region(lissom_context* context, lissom_mesh mesh, const char* name,
                                     lissom_region region) {
    return run(context, [&] {
        Mesh& own = mesh_of(*context, mesh);
        own.set_region(given_name(name, "name"), region_of(*context, region));
        context->sharing.changed(own);
    });
}

lissom_status lissom_region_combine(lissom_context* context, lissom_region a, lissom_region b,
                                    lissom_region_operation operation, lissom_region* region) {
    return run(context, [&] {
        add_region(*context, combined(region_of(*context, a), region_of(*context, b), operation),
                   region);
    });
}

lissom_status lissom_region_invert(lissom_context* context, lissom_region a,
                                   lissom_region* region) {
    return run(context, [&] { add_region(*context, region_of(*context, a).inverted(), region); });
}

lissom_status lissom_region_grow(lissom_context* context, lissom_region a, int32_t rings,
                                 lissom_region* region) {
    return run(context, [&] {
        const Region& own = region_of(*context, a);
        // The least number has no opposite.
        const Index inward = -std::max(rings, -std::numeric_limits<Index>::max());
        add_region(*context, rings < 0 ? own.shrunk(inward) : own.grown(rings), region);
    });
}

int32_t lissom_region_size(lissom_context* context, lissom_region region) {
    return context ? context->count([&] { return region_of(*context, region).size(); }) : -1;
}

lissom_status lissom_region_read_vertices(lissom_context* context, lissom_region region,
                                          const lissom_output* vertices) {
    return run(context, [&] {
        write_integers(vertices, region_of(*context, region).vertices(), "vertices");
    });
}

}  // extern "C"
