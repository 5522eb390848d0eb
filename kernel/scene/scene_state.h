/// SceneState: the objects of a scene, each with its place and look, and their contents at one
/// time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/scene/scene_item.h"

namespace lissom {

/// Look of a drawn object; fields without a use for its kind are ignored. Colours are sRGB, each
/// part 0 to 1.
struct ObjectStyle {
    /// Absent: that of its kind, or of a mesh's vertices.
    std::optional<Vec3> color = std::nullopt;
    /// Draw the colours of the attribute "color" if a mesh has it.
    bool vertex_colors = true;
    /// Draw one normal a face instead of smooth ones.
    bool flat = false;
    /// Angle in radians between the normals of faces above which their edge is sharp.
    double crease = 50.0 * kDegree;
    /// Draw the polygons' edges.
    bool wire = false;
    std::optional<Vec3> wire_color = std::nullopt;
    /// Width in pixels of these edges, and of curves and open boundaries.
    double wire_width = 1.0;
    double line_width = 4.0;
    /// Draw the loops of open boundaries.
    bool boundaries = false;
    /// The named region of a mesh that is drawn in a colour of its own; none if empty.
    std::string region = {};
    /// Draw region and handles of a deformation on its mesh.
    bool handles = true;
    /// Part of the strands that is drawn, above 0 and at most 1.
    double level = 1.0;

    bool operator==(const ObjectStyle&) const = default;
};

/// Names an object of a scene for as long as the scene lives; never given again.
struct ObjectId {
    std::uint64_t value = 0;
    bool operator==(const ObjectId&) const = default;
};

/// Placement and appearance of an object in its scene.
struct ObjectLook {
    /// Map from the object's own space to that of the scene.
    Affine transform = {};
    bool visible = true;
    ObjectStyle style = {};

    bool operator==(const ObjectLook&) const = default;
};

/// Errors: not_finite for a transform; singular_transform if it flattens space; invalid_argument
/// for a value of the style out of range.
void require_look(const ObjectLook& look);

/// An object of a scene at one time; immutable once the scene has it.
struct NamedObject {
    ObjectId id;
    std::string name;
    ObjectLook look;
    std::shared_ptr<SceneItem> item;
};

/// The objects of a scene in their order.
using ObjectList = std::vector<std::shared_ptr<const NamedObject>>;

/// The content of an item at one time.
struct CapturedItem {
    std::shared_ptr<SceneItem> item;
    std::shared_ptr<const ItemContent> content;

    bool operator==(const CapturedItem&) const = default;
};

/// A scene at one time; immutable.
struct SceneState {
    ObjectList objects;
    /// All items of the objects, each once, parts before their wholes.
    std::vector<CapturedItem> items;

    /// Returns the content of the item of this identity, or null; found at once if it is the one at
    /// `hint`.
    std::shared_ptr<const ItemContent> find(const void* identity, std::size_t hint = 0) const;
    bool operator==(const SceneState&) const = default;
};

/// Bytes that a state's contents count.
std::size_t bytes_of(const SceneState& state);

/// Hash of names, order, looks and contents; see Scene::hash.
std::uint64_t hash(const SceneState& state);

}  // namespace lissom
