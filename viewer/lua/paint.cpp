#include "viewer/lua/paint.h"

#include <algorithm>
#include <string>

#include "bindings/lua/mesh/mesh_object.h"
#include "kernel/core/error.h"
#include "viewer/render/draw/image/color.h"

namespace lissom {
namespace {

// Calls `paint(style, region)` for every mesh with a region called `name`.
template <typename Paint>
void paint_named(Picture& picture, std::string_view name, const Paint& paint) {
    bool found = false;
    std::vector<std::string_view> names;
    for (DrawnMesh& drawn : picture.meshes) {
        if (const Region* region = drawn.mesh->find_region(name)) {
            paint(drawn.style, *region);
            found = true;
        }
        for (const auto& [key, value] : regions_of(drawn)) names.push_back(key);
    }
    if (!found) lua::refuse_absent("region", name, names);
}

// Calls `paint(style, region)` for every mesh that the region is of.
template <typename Paint>
void paint_given(Picture& picture, const Region& region, const char* what, const Paint& paint) {
    bool found = false;
    for (DrawnMesh& drawn : picture.meshes) {
        if (drawn.mesh->shared_topology() != region.topology()) continue;
        paint(drawn.style, region);
        found = true;
    }
    if (found) return;
    throw Error(ErrorCode::topology_mismatch,
                std::string(what) +
                    " belongs to none of the meshes in the picture as they are now; make it again "
                    "on the mesh that is drawn");
}

void set_region(MeshStyle& style, const Region& region) {
    style.region = region;
}
void add_handle(MeshStyle& style, const Region& region) {
    style.handles.push_back(region);
}

void require_drawable(const Attribute& attribute) {
    if (attribute.domain == Domain::vertex && attribute.width == 1) return;
    throw Error(ErrorCode::invalid_argument,
                "the attribute '" + attribute.name +
                    "' cannot be drawn: it must have one number for each vertex");
}

}  // namespace

void paint_mesh(MeshStyle& style, std::string_view color) {
    const std::size_t parts = color.starts_with('#') ? color.size() - 1 : 0;
    if (parts != 4 && parts != 8) {
        style.color = parse_color(color);
        return;
    }
    const std::size_t digits = parts / 4;
    const std::string_view alpha = color.substr(1 + 3 * digits);
    const std::string level = "#" + std::string(alpha) + std::string(alpha) + std::string(alpha);
    try {
        const double opacity = parse_color(level).r;
        style.color = parse_color(color.substr(0, 1 + 3 * digits));
        style.opacity = opacity;
    } catch (const Error&) {
        parse_color(color);  // lists the accepted forms
    }
}

void paint_region(Picture& picture, std::string_view name) {
    paint_named(picture, name, set_region);
}

void paint_region(Picture& picture, const Region& region) {
    paint_given(picture, region, "the region", set_region);
}

void require_region(const Picture& picture, std::string_view name) {
    std::vector<std::string_view> names;
    for (const DrawnMesh& drawn : picture.meshes) {
        if (drawn.mesh->find_region(name)) return;
        for (const auto& [key, value] : regions_of(drawn)) names.push_back(key);
    }
    lua::refuse_absent("region", name, names);
}

void paint_handle(Picture& picture, std::string_view name) {
    paint_named(picture, name, add_handle);
}

void paint_handle(Picture& picture, const Region& handle) {
    paint_given(picture, handle, "the handle", add_handle);
}

void paint_values(Picture& picture, std::string_view attribute) {
    bool found = false;
    std::vector<std::string_view> names;
    for (DrawnMesh& drawn : picture.meshes) {
        for (const Attribute& other : drawn.mesh->attributes().all()) names.push_back(other.name);
        const Attribute* values = drawn.mesh->attributes().find(attribute);
        if (!values) continue;
        require_drawable(*values);
        drawn.style.values = values->values;
        found = true;
    }
    if (!found) lua::refuse_absent("attribute", attribute, names);
    picture.legend_label = attribute;
}

void paint_values(Picture& picture, const std::vector<double>& values) {
    bool found = false;
    for (DrawnMesh& drawn : picture.meshes) {
        if (values.size() != at(drawn.mesh->vertex_count())) continue;
        drawn.style.values = values;
        found = true;
    }
    if (found) return;
    throw Error(ErrorCode::invalid_argument,
                std::to_string(values.size()) +
                    " values were given, but no mesh of the picture has as many vertices");
}

}  // namespace lissom
