// Validity and end of objects.
#include "bindings/c/context.h"
#include "kernel/mesh/region.h"

namespace lissom::c {
namespace {

bool is_valid(const lissom_context* context, std::uint64_t id, Kind kind) {
    return context && context->objects.find(id, kind) != nullptr;
}

lissom_status release(lissom_context* context, std::uint64_t id, Kind kind) {
    return run(context, [&] {
        const ObjectTable::Object* object = context->objects.find(id, kind);
        if (!object) {
            throw StatusError(LISSOM_INVALID_HANDLE,
                              "the object was released already, or never was");
        }
        if (object->jobs > 0) {
            throw StatusError(LISSOM_BUSY, "a job works with the object; finish the job first");
        }
        context->objects.release(id);
    });
}

}  // namespace
}  // namespace lissom::c

using namespace lissom::c;

extern "C" {

bool lissom_mesh_is_valid(const lissom_context* context, lissom_mesh mesh) {
    return is_valid(context, mesh.id, Kind::mesh);
}
bool lissom_region_is_valid(const lissom_context* context, lissom_region region) {
    return is_valid(context, region.id, Kind::region);
}
bool lissom_deformer_is_valid(const lissom_context* context, lissom_deformer deformer) {
    return is_valid(context, deformer.id, Kind::deformer);
}
bool lissom_pose_is_valid(const lissom_context* context, lissom_pose pose) {
    return is_valid(context, pose.id, Kind::pose);
}
bool lissom_pose_space_is_valid(const lissom_context* context, lissom_pose_space space) {
    return is_valid(context, space.id, Kind::pose_space);
}
bool lissom_merger_is_valid(const lissom_context* context, lissom_merger merger) {
    return is_valid(context, merger.id, Kind::merger);
}
bool lissom_paste_is_valid(const lissom_context* context, lissom_paste paste) {
    return is_valid(context, paste.id, Kind::paste);
}
bool lissom_hairstyle_is_valid(const lissom_context* context, lissom_hairstyle style) {
    return is_valid(context, style.id, Kind::hairstyle);
}
bool lissom_strands_is_valid(const lissom_context* context, lissom_strands strands) {
    return is_valid(context, strands.id, Kind::strands);
}
bool lissom_render_map_is_valid(const lissom_context* context, lissom_render_map map) {
    return is_valid(context, map.id, Kind::render_map);
}
bool lissom_script_is_valid(const lissom_context* context, lissom_script script) {
    return is_valid(context, script.id, Kind::script);
}
bool lissom_object_is_valid(const lissom_context* context, lissom_object object) {
    return is_valid(context, object.id, Kind::object);
}

lissom_status lissom_mesh_release(lissom_context* context, lissom_mesh mesh) {
    return release(context, mesh.id, Kind::mesh);
}
lissom_status lissom_region_release(lissom_context* context, lissom_region region) {
    return release(context, region.id, Kind::region);
}
lissom_status lissom_deformer_release(lissom_context* context, lissom_deformer deformer) {
    return release(context, deformer.id, Kind::deformer);
}
lissom_status lissom_pose_release(lissom_context* context, lissom_pose pose) {
    return release(context, pose.id, Kind::pose);
}
lissom_status lissom_pose_space_release(lissom_context* context, lissom_pose_space space) {
    return release(context, space.id, Kind::pose_space);
}
lissom_status lissom_merger_release(lissom_context* context, lissom_merger merger) {
    return release(context, merger.id, Kind::merger);
}
lissom_status lissom_paste_release(lissom_context* context, lissom_paste paste) {
    return release(context, paste.id, Kind::paste);
}
lissom_status lissom_hairstyle_release(lissom_context* context, lissom_hairstyle style) {
    return release(context, style.id, Kind::hairstyle);
}
lissom_status lissom_strands_release(lissom_context* context, lissom_strands strands) {
    return release(context, strands.id, Kind::strands);
}
lissom_status lissom_render_map_release(lissom_context* context, lissom_render_map map) {
    return release(context, map.id, Kind::render_map);
}
lissom_status lissom_script_release(lissom_context* context, lissom_script script) {
    return release(context, script.id, Kind::script);
}
lissom_status lissom_object_release(lissom_context* context, lissom_object object) {
    return release(context, object.id, Kind::object);
}

}  // extern "C"
