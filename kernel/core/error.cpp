#include "kernel/core/error.h"

#include <algorithm>
#include <array>
#include <utility>

#include "kernel/core/memory_error.h"

namespace lissom {
namespace {

struct CodeEntry {
    ErrorCode code;
    std::string_view name;
    std::string_view explanation;
};

constexpr std::array<CodeEntry, 41> kCodes{{
    {ErrorCode::cancelled, "cancelled",
     "The operation was asked to stop and stopped; nothing was changed. Start it again."},
    {ErrorCode::invalid_argument, "invalid_argument",
     "An argument has a value that the operation cannot use. The message names the argument and "
     "the values it accepts."},
    {ErrorCode::out_of_range, "out_of_range",
     "An id or number is out of range. Vertices and faces count from 1 in Lua and from 0 in C++; "
     "ids of an older version of a mesh may have gone."},
    {ErrorCode::file_not_found, "file_not_found",
     "No file has this path. Relative paths start at the current folder; check spelling and case."},
    {ErrorCode::file_is_directory, "file_is_directory",
     "The path names a folder but a file is needed. Add the file's name."},
    {ErrorCode::file_empty, "file_empty",
     "The file has no content. It may not have been written fully."},
    {ErrorCode::file_unreadable, "file_unreadable",
     "The file exists but cannot be read. Check its permissions and the disk."},
    {ErrorCode::file_write_failed, "file_write_failed",
     "The file could not be written; a file that was there before is untouched. Check that "
     "the folder exists, its permissions and the free space."},
    {ErrorCode::file_syntax, "file_syntax",
     "The content does not follow the file's format. The message names the line or the "
     "element; the file may be of another format than its extension says."},
    {ErrorCode::file_truncated, "file_truncated",
     "The file ends before all the elements its header announces. Copy or export it again."},
    {ErrorCode::file_too_large, "file_too_large",
     "The header announces more elements than the file can hold or this build can number. The "
     "file is damaged, or it must be split."},
    {ErrorCode::unknown_format, "unknown_format",
     "The extension is none that can be read or written. Use one that the message lists."},
    {ErrorCode::unsafe_path, "unsafe_path",
     "A file refers to another file outside its own folder. Put the files together and use plain "
     "relative names."},
    {ErrorCode::not_finite, "not_finite",
     "A position or value is NaN or infinite. Find the element in the program that wrote it."},
    {ErrorCode::mesh_empty, "mesh_empty",
     "The mesh has no vertices or no faces, and the operation needs them."},
    {ErrorCode::face_index, "face_index",
     "A face refers to a vertex that does not exist. Faces count vertices from 1 in Lua and OBJ."},
    {ErrorCode::face_too_small, "face_too_small",
     "A face has fewer than three vertices. Remove it."},
    {ErrorCode::repeated_vertex, "repeated_vertex",
     "A face uses one vertex twice. Remove the repeated entry, or the face if two corners remain."},
    {ErrorCode::duplicate_face, "duplicate_face",
     "Two faces have the same vertices in the same order. Remove one of them."},
    {ErrorCode::nonmanifold_edge, "nonmanifold_edge",
     "More than two faces meet at an edge, so the surface has no inside and outside there. "
     "Split or remove the extra faces."},
    {ErrorCode::nonmanifold_vertex, "nonmanifold_vertex",
     "The faces around a vertex form several separate fans that touch only there. Duplicate "
     "the vertex, one copy for each fan."},
    {ErrorCode::inconsistent_orientation, "inconsistent_orientation",
     "Two neighbouring faces run along their common edge in the same direction, so one is "
     "inside out. Orient the faces consistently."},
    {ErrorCode::unreferenced_vertex, "unreferenced_vertex",
     "Vertices are used by no face. Load with repair = true to drop them."},
    {ErrorCode::zero_area, "zero_area",
     "Faces have no area, so no surface operator exists at a vertex that has no others. "
     "Collapse or remove those faces, or keep the vertex out of the region."},
    {ErrorCode::region_empty, "region_empty",
     "The region has no vertices. Enlarge the sphere, box or radius that selects it."},
    {ErrorCode::topology_mismatch, "topology_mismatch",
     "A region, path or handle belongs to another mesh or to an older version of this mesh's "
     "topology, or the mesh has changed around the region of a deformation and the result would "
     "tear there. Make it again on the mesh as it is now."},
    {ErrorCode::handle_outside_region, "handle_outside_region",
     "A handle has vertices outside the region that may deform. Enlarge the region or shrink the "
     "handle."},
    {ErrorCode::handle_overlap, "handle_overlap",
     "Two handles share vertices, which then could not follow both. Make them disjoint."},
    {ErrorCode::handle_removed, "handle_removed",
     "The handle was removed from its deformer or the deformer was closed. Make a new handle."},
    {ErrorCode::singular_transform, "singular_transform",
     "The transform flattens space (its determinant is zero) or is not finite. Scale by "
     "factors other than zero."},
    {ErrorCode::unconstrained, "unconstrained",
     "A connected part of the region has too few constraints to have one shape: nothing holds "
     "it. Add a handle there, or leave some of its vertices out of the region."},
    {ErrorCode::not_a_boundary, "not_a_boundary",
     "A path that has to be a whole open boundary of its mesh is not one. Take it from the mesh's "
     "boundaries, or cut the mesh along it first."},
    {ErrorCode::not_a_disk, "not_a_disk",
     "The surface to be laid out in the plane is no disk, with or without holes: it is closed, has "
     "handles, falls into parts, or has a hole that cannot be closed. Choose a region that is "
     "one."},
    {ErrorCode::boundary_conflict, "boundary_conflict",
     "Boundaries or cuts get in each other's way: two joins share one, a loop crosses itself or "
     "has no length, or a cut runs into an open boundary. The message names the vertices."},
    {ErrorCode::key_conflict, "key_conflict",
     "Key correspondences contradict each other: a key lies off its boundary, two keys fall on one "
     "place, or their cyclic order differs between the two boundaries. Correct the keys named."},
    {ErrorCode::skin_mismatch, "skin_mismatch",
     "Two meshes are moved by different joints, so that their skin weights cannot be joined. Give "
     "both the same joints, or remove the attributes \"joints\" and \"weights\" of one."},
    {ErrorCode::not_positive_definite, "not_positive_definite",
     "The linear system has no unique solution. A part of the mesh lacks a constraint, or its "
     "triangles are too degenerate."},
    {ErrorCode::memory_limit, "memory_limit",
     "The operation would need more memory than the context allows, or than there is. Raise the "
     "limit, or use a smaller region or mesh."},
    {ErrorCode::unsupported, "unsupported",
     "The request is valid but this build or format cannot serve it. The message names the "
     "supported choices."},
    {ErrorCode::no_display, "no_display",
     "Pictures need EGL and OpenGL 3.3, and one of them is missing. Install the EGL library and a "
     "driver (on Debian: libegl1 libgl1-mesa-dri)."},
    {ErrorCode::internal, "internal",
     "An invariant of the kernel does not hold: a defect. Please report it with the input "
     "that shows it."},
}};

const CodeEntry& entry(ErrorCode code) {
    return kCodes[static_cast<std::size_t>(code)];
}

std::string plural(ElementKind kind) {
    if (kind == ElementKind::vertex) return "vertices";
    return std::string(kind_name(kind)) + "s";
}

bool continues_character(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

// Messages quote names, which may be of any length. The ends of a message say what happened and
// what to do, so the middle is left out. Characters of UTF-8 stay whole.
std::string shortened(std::string message) {
    constexpr std::size_t kLongest = 4096;
    if (message.size() <= kLongest) return message;
    std::size_t first = kLongest / 2, last = message.size() - kLongest / 2;
    while (first > 0 && continues_character(message[first])) --first;
    while (last < message.size() && continues_character(message[last])) ++last;
    return message.substr(0, first) + " [...] " + message.substr(last);
}

}  // namespace

void Elements::add(Index id) {
    ++count;
    if (ids.size() < kMaximumIds) ids.push_back(id);
}

void Elements::add_edge(Index a, Index b) {
    ++count;
    if (ids.size() + 2 > kMaximumIds) return;
    ids.push_back(a);
    ids.push_back(b);
}

Error::Error(ErrorCode code, std::string message, Elements elements)
    : code_(code), message_(shortened(std::move(message))), elements_(std::move(elements)) {}

std::string_view code_name(ErrorCode code) {
    return entry(code).name;
}

std::string_view code_explanation(ErrorCode code) {
    return entry(code).explanation;
}

const std::vector<ErrorCode>& all_codes() {
    static const std::vector<ErrorCode> codes = [] {
        std::vector<ErrorCode> list;
        for (const CodeEntry& e : kCodes) list.push_back(e.code);
        return list;
    }();
    return codes;
}

std::string_view kind_name(ElementKind kind) {
    constexpr std::array<std::string_view, 9> names{
        "element", "vertex", "edge", "face", "corner", "row", "component", "line", "strand"};
    return names[static_cast<std::size_t>(kind)];
}

std::string describe(const Elements& elements, Index base, std::size_t limit) {
    const std::size_t per_element = elements.kind == ElementKind::edge ? 2 : 1;
    const std::size_t shown = std::min(limit, elements.ids.size() / per_element);
    std::string text =
        elements.count == 1 ? std::string(kind_name(elements.kind)) : plural(elements.kind);
    for (std::size_t i = 0; i < shown; ++i) {
        text += i == 0 ? " " : (i + 1 == shown && shown == elements.count ? " and " : ", ");
        text += std::to_string(elements.ids[i * per_element] + base);
        if (per_element == 2) text += "-" + std::to_string(elements.ids[2 * i + 1] + base);
    }
    if (shown < elements.count) text += " (of " + std::to_string(elements.count) + ")";
    return text;
}

void throw_out_of_memory() {
    std::string message = "out of memory";
    try {
        message =
            "there is not enough memory; close other programs, or use a smaller mesh or region";
    } catch (const std::bad_alloc&) {
        // The short message needs none.
    }
    throw Error(ErrorCode::memory_limit, std::move(message));
}

}  // namespace lissom
