// Attributes and labels of meshes, and where their elements come from.
#include "kernel/mesh/attributes.h"

#include <algorithm>
#include <cctype>
#include <cstring>

#include "bindings/c/attributes/attribute_space.h"
#include "bindings/c/data.h"
#include "bindings/c/origins.h"
#include "kernel/core/nearest.h"

namespace lissom::c {
namespace {

const Attribute& attribute_of(const Mesh& mesh, const std::string& name) {
    const Attribute* found = mesh.attributes().find(name);
    if (found) return *found;
    std::vector<std::string_view> names;
    for (const Attribute& one : mesh.attributes().all()) names.push_back(one.name);
    throw Error(ErrorCode::out_of_range,
                "the mesh has no attribute '" + name + "'" + name_hint(name, names));
}

void tell_attribute(lissom_context& context, const Attribute& found, lissom_attribute* told) {
    require_given(told, "attribute");
    take_options(told, lissom_default_attribute());
    context.text = found.name;
    lissom_attribute result = lissom_default_attribute();
    result.name = context.text.c_str();
    result.domain = static_cast<lissom_domain>(found.domain);
    result.width = found.width;
    result.count = found.size();
    result.struct_size = told->struct_size;
    std::memcpy(told, &result, std::min(told->struct_size, sizeof result));
}

ScalarType scalar_type(lissom_format format) {
    switch (format) {
        case LISSOM_FLOAT64:
            return ScalarType::float64;
        case LISSOM_UINT32:
            return ScalarType::uint32;
        case LISSOM_INT32:
            return ScalarType::int32;
        case LISSOM_UINT8:
        case LISSOM_UNORM8:
            return ScalarType::uint8;
        case LISSOM_UINT16:
        case LISSOM_UNORM16:
            return ScalarType::uint16;
        default:
            return ScalarType::float32;
    }
}

bool is_numbered(std::string_view name, std::string_view stem) {
    return name.starts_with(stem) &&
           std::all_of(name.begin() + static_cast<std::ptrdiff_t>(stem.size()), name.end(),
                       [](unsigned char c) { return std::isdigit(c) != 0; });
}

bool has_meaning(std::string_view name) {
    constexpr std::string_view kNames[] = {"normal", "face_normal", "tangent", "joints", "weights"};
    return is_numbered(name, "uv") || is_numbered(name, "color") || name.starts_with("morph.") ||
           std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

void require_sound(const Attribute& attribute, Index count) {
    require(attribute.domain >= Domain::vertex && attribute.domain <= Domain::face,
            "there is no such domain");
    require(!attribute.name.empty(), "an attribute needs a name");
    if (has_meaning(attribute.name) && role_of(attribute) == AttributeRole::value) {
        throw Error(ErrorCode::invalid_argument,
                    "attribute '" + attribute.name + "' does not have " +
                        std::to_string(attribute.width) + " numbers an element");
    }
    if (attribute.size() == count) return;
    throw Error(ErrorCode::invalid_argument,
                "attribute '" + attribute.name + "' has " + std::to_string(attribute.size()) +
                    " elements given, and the mesh has " + std::to_string(count));
}

const FaceLabels& labels_of(const Mesh& mesh, const std::string& kind) {
    const auto found = mesh.attributes().labels().find(kind);
    if (found == mesh.attributes().labels().end()) {
        throw Error(ErrorCode::out_of_range, "the mesh has no labels '" + kind + "'");
    }
    return found->second;
}

FaceLabels given_labels(const Mesh& mesh, const char* const* names, Index name_count,
                        const lissom_input* labels) {
    require(name_count >= 0, "name_count is negative");
    if (name_count > 0) require_given(names, "names");
    FaceLabels made;
    for (Index i = 0; i < name_count; ++i) made.names.push_back(given_name(names[i], "a name"));
    made.of_face = read_labels(labels, "labels");
    require(count_of(made.of_face) == mesh.face_count(), "labels need one element a face");
    for (const Index label : made.of_face) {
        if (label < name_count) continue;
        throw Error(ErrorCode::out_of_range,
                    "label " + std::to_string(label) + " has no name: the names given are " +
                        std::to_string(name_count) + ", and labels count from 0");
    }
    return made;
}

void write_origins(lissom_context& context, lissom_mesh mesh, bool of_faces,
                   const lissom_output* inputs, const lissom_output* elements) {
    const Mesh& own = mesh_of(context, mesh);
    const auto* object = context.objects.find(mesh.id, Kind::mesh);
    const auto* found = static_cast<const Origins*>(object->beside.get());
    if (!found || found->topology.lock() != own.shared_topology()) {
        throw Error(ErrorCode::out_of_range,
                    "the mesh has no origins: it does not come from a merge, a paste or an "
                    "erasure, or has another topology by now");
    }
    const OriginList& list = of_faces ? found->faces : found->vertices;
    if (elements) require_room(elements, list.element.size(), 1, "elements");
    if (inputs) write_integers(inputs, list.input, "inputs");
    if (elements) write_integers(elements, list.element, "elements");
}

}  // namespace
}  // namespace lissom::c

using namespace lissom;
using namespace lissom::c;

extern "C" {

lissom_attribute lissom_default_attribute(void) {
    lissom_attribute attribute{};
    attribute.struct_size = sizeof attribute;
    attribute.name = "";
    return attribute;
}

int32_t lissom_mesh_attribute_count(lissom_context* context, lissom_mesh mesh) {
    if (!context) return -1;
    return context->count([&] { return count_of(shown_mesh(*context, mesh).attributes().all()); });
}

lissom_status lissom_mesh_attribute(lissom_context* context, lissom_mesh mesh, int32_t number,
                                    lissom_attribute* attribute) {
    return run(context, [&] {
        const auto& all = shown_mesh(*context, mesh).attributes().all();
        if (number < 0 || number >= count_of(all)) {
            throw Error(ErrorCode::out_of_range, "the mesh has " + std::to_string(all.size()) +
                                                     " attributes, numbered from 0");
        }
        tell_attribute(*context, all[at(number)], attribute);
    });
}

lissom_status lissom_mesh_find_attribute(lissom_context* context, lissom_mesh mesh,
                                         const char* name, lissom_attribute* attribute) {
    return run(context, [&] {
        tell_attribute(*context, attribute_of(shown_mesh(*context, mesh), given_text(name, "name")),
                       attribute);
    });
}

lissom_status lissom_mesh_read_attribute(lissom_context* context, lissom_mesh mesh,
                                         const char* name, const lissom_output* values) {
    return run(context, [&] {
        const Mesh& own = shown_mesh(*context, mesh);
        const Attribute& found = attribute_of(own, given_text(name, "name"));
        std::vector<Index> order;
        if (found.domain == Domain::corner && context->space.reverses()) {
            order = host_corners(own.topology());
        }
        write_attribute(values, found, found.size(), context->space,
                        [&](std::size_t i) { return order.empty() ? index_of(i) : order[i]; });
    });
}

lissom_status lissom_mesh_write_attribute(lissom_context* context, lissom_mesh mesh,
                                          const char* name, lissom_domain domain, int32_t width,
                                          const lissom_input* values) {
    return run(context, [&] {
        Mesh& own = mesh_of(*context, mesh);
        Attribute made;
        made.name = given_name(name, "name");
        made.domain = static_cast<Domain>(domain);
        made.width = width;
        made.values = read_numbers(values, width, "values");
        made.type = scalar_type(values->format);
        require_sound(made, domain >= LISSOM_ON_VERTICES && domain <= LISSOM_ON_FACES
                                ? element_count(own.topology(), made.domain)
                                : 0);
        if (made.domain == Domain::corner && context->space.reverses()) {
            reorder(made, host_corners(own.topology()));
        }
        to_kernel_space(made, context->space);
        own.attributes().add(std::move(made));
        context->sharing.changed(own);
    });
}

lissom_status lissom_mesh_remove_attribute(lissom_context* context, lissom_mesh mesh,
                                           const char* name) {
    return run(context, [&] {
        Mesh& own = mesh_of(*context, mesh);
        const std::string text = given_text(name, "name");
        attribute_of(own, text);
        own.attributes().remove(text);
        context->sharing.changed(own);
    });
}

int32_t lissom_mesh_label_count(lissom_context* context, lissom_mesh mesh, const char* kind) {
    if (!context) return -1;
    return context->count([&] {
        const auto& all = shown_mesh(*context, mesh).attributes().labels();
        const auto found = all.find(given_text(kind, "kind"));
        return found == all.end() ? 0 : count_of(found->second.names);
    });
}

lissom_status lissom_mesh_label_name(lissom_context* context, lissom_mesh mesh, const char* kind,
                                     int32_t label, const char** name) {
    return run(context, [&] {
        require_given(name, "name");
        const FaceLabels& found = labels_of(shown_mesh(*context, mesh), given_text(kind, "kind"));
        if (label < 0 || label >= count_of(found.names)) {
            throw Error(ErrorCode::out_of_range, "there are " + std::to_string(found.names.size()) +
                                                     " labels, numbered from 0");
        }
        context->text = found.names[at(label)];
        *name = context->text.c_str();
    });
}

lissom_status lissom_mesh_read_labels(lissom_context* context, lissom_mesh mesh, const char* kind,
                                      const lissom_output* labels) {
    return run(context, [&] {
        write_integers(labels,
                       labels_of(shown_mesh(*context, mesh), given_text(kind, "kind")).of_face,
                       "labels");
    });
}

lissom_status lissom_mesh_write_labels(lissom_context* context, lissom_mesh mesh, const char* kind,
                                       const char* const* names, int32_t name_count,
                                       const lissom_input* labels) {
    return run(context, [&] {
        Mesh& own = mesh_of(*context, mesh);
        const std::string text = given_name(kind, "kind");
        require(!text.empty(), "kind is empty");
        FaceLabels made = given_labels(own, names, name_count, labels);
        AttributeSet next = own.attributes();
        next.labels()[text] = std::move(made);
        next.recount();
        own.attributes() = std::move(next);
        context->sharing.changed(own);
    });
}

lissom_status lissom_mesh_read_vertex_origins(lissom_context* context, lissom_mesh mesh,
                                              const lissom_output* inputs,
                                              const lissom_output* elements) {
    return run(context, [&] { write_origins(*context, mesh, false, inputs, elements); });
}

lissom_status lissom_mesh_read_face_origins(lissom_context* context, lissom_mesh mesh,
                                            const lissom_output* inputs,
                                            const lissom_output* elements) {
    return run(context, [&] { write_origins(*context, mesh, true, inputs, elements); });
}

}  // extern "C"
