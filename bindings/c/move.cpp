// Objects that move to another context.
#include <utility>

#include "bindings/c/context.h"
#include "kernel/hair/strands/strands.h"

namespace lissom::c {
namespace {

// On the account of the other context, as are its topology, attributes and regions.
Mesh moved_mesh(const Mesh& mesh, const Context& other) {
    const auto positions = mesh.positions();
    Mesh made({positions.begin(), positions.end()}, mesh.topology().faces(), other);
    made.attributes() = mesh.attributes();
    for (const auto& [name, region] : mesh.regions()) {
        made.set_region(name, Region(made.shared_topology(), region.vertices()));
    }
    made.material_libraries() = mesh.material_libraries();
    made.set_asset(mesh.asset());
    made.set_report(mesh.report());
    return made;
}

Strands moved_strands(const Strands& strands, const Context& other) {
    const auto points = strands.points();
    const auto offsets = strands.offsets();
    Strands made({points.begin(), points.end()}, {offsets.begin(), offsets.end()}, other.memory());
    made.set_widths(strands.widths());
    made.set_roots(strands.roots());
    made.set_groups(strands.groups(), strands.group_names());
    made.set_ids(strands.ids());
    made.set_guides(strands.guides());
    if (strands.colors()) made.set_colors(*strands.colors());
    made.set_transparency(strands.transparency());
    made.set_comment(strands.comment());
    return made;
}

Kind kind_of(lissom_context& context, std::uint64_t id) {
    for (const Kind kind : {Kind::mesh, Kind::region, Kind::deformer, Kind::merger, Kind::paste,
                            Kind::hairstyle, Kind::strands, Kind::script, Kind::object,
                            Kind::render_map, Kind::pose, Kind::pose_space}) {
        if (context.objects.find(id, kind)) return kind;
    }
    throw StatusError(LISSOM_INVALID_HANDLE,
                      "the handle names no object of this context: it was released, or comes from "
                      "another context");
}

[[noreturn]] void refuse_move(Kind kind) {
    const char* remedy =
        "a region belongs to a mesh: keep it with the mesh by "
        "lissom_mesh_set_region, move the mesh, and find it by "
        "lissom_region_named";
    if (kind == Kind::hairstyle) {
        remedy = "a style belongs to a head: encode it, move the head, and decode it there";
    } else if (kind == Kind::script || kind == Kind::object) {
        remedy =
            "scripts and their objects belong to the Lua state of their context: load the "
            "script there";
    } else if (kind == Kind::render_map) {
        remedy =
            "a render map belongs to a mesh: move the mesh, and make its map there by "
            "lissom_render_map_create";
    } else if (kind == Kind::pose) {
        remedy = "a pose belongs to a deformer: make both in the other context";
    } else if (kind != Kind::region) {
        remedy = "the object keeps the systems of its meshes: move these, and make it there";
    }
    throw Error(ErrorCode::unsupported, remedy);
}

std::uint64_t move_object(lissom_context& context, std::uint64_t id, lissom_context& other) {
    const Kind kind = kind_of(context, id);
    if (kind == Kind::mesh) {
        return other.add_mesh(moved_mesh(context.content<Mesh>(id, kind), other.kernel));
    }
    if (kind != Kind::strands) refuse_move(kind);
    return other.add(kind, other.sharing.make_strands(
                               moved_strands(context.content<Strands>(id, kind), other.kernel)));
}

}  // namespace
}  // namespace lissom::c

using namespace lissom::c;

extern "C" lissom_status lissom_move(lissom_context* context, uint64_t object,
                                     lissom_context* other, uint64_t* moved) {
    return run(context, [&] {
        require_given(other, "other");
        require_given(moved, "moved");
        lissom::require(other != context, "both contexts are the same");
        *moved = move_object(*context, object, *other);
        context->objects.release(object);
    });
}
