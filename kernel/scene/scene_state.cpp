#include "kernel/scene/scene_state.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "kernel/core/error.h"
#include "kernel/core/hasher.h"

namespace lissom {
namespace {

bool is_color(const std::optional<Vec3>& color) {
    return !color || ((color->array() >= 0.0).all() && (color->array() <= 1.0).all());
}

bool is_positive(double value) {
    return value > 0.0 && std::isfinite(value);
}

void require_style(const ObjectStyle& style) {
    require(is_color(style.color) && is_color(style.wire_color), "colours are from 0 to 1");
    require(style.crease >= 0.0 && style.crease <= kPi, "crease must be from 0 to half a turn");
    require(is_positive(style.wire_width) && is_positive(style.line_width),
            "widths must be above 0");
    require(style.level > 0.0 && style.level <= 1.0, "level must be above 0 and at most 1");
}

void add_color(Hasher& hasher, const std::optional<Vec3>& color) {
    hasher.add(color.has_value());
    if (!color) return;
    for (const double part : *color) hasher.add(part);
}

void add_look(Hasher& hasher, const ObjectLook& look) {
    for (const double x : look.transform.linear.reshaped()) hasher.add(x);
    for (const double x : look.transform.translation) hasher.add(x);
    hasher.add(look.visible);
    const ObjectStyle& style = look.style;
    add_color(hasher, style.color);
    add_color(hasher, style.wire_color);
    for (const bool flag :
         {style.vertex_colors, style.flat, style.wire, style.boundaries, style.handles}) {
        hasher.add(flag);
    }
    for (const double x : {style.crease, style.wire_width, style.line_width, style.level}) {
        hasher.add(x);
    }
    hasher.add(style.region);
}

}  // namespace

void require_look(const ObjectLook& look) {
    const Affine& t = look.transform;
    require(t.is_finite(), "the transform of an object must be finite", ErrorCode::not_finite);
    require(t.linear.determinant() != 0.0,
            "the transform flattens the object; scale by factors other than zero",
            ErrorCode::singular_transform);
    require_style(look.style);
}

std::shared_ptr<const ItemContent> SceneState::find(const void* identity, std::size_t hint) const {
    if (hint < items.size() && items[hint].item->identity() == identity) return items[hint].content;
    for (const CapturedItem& captured : items) {
        if (captured.item->identity() == identity) return captured.content;
    }
    return nullptr;
}

std::size_t bytes_of(const SceneState& state) {
    std::vector<const KeptBytes*> list;
    for (const CapturedItem& captured : state.items) captured.content->list_kept(list);
    return bytes_of(std::move(list));
}

// An object counts by the place of its item among all, so that two of one item differ from two of
// equal content.
std::uint64_t hash(const SceneState& state) {
    Hasher hasher;
    hasher.add(count_of(state.items));
    for (const CapturedItem& captured : state.items) hasher.add(captured.content->hash());
    hasher.add(count_of(state.objects));
    for (const auto& object : state.objects) {
        const auto is_its = [&](const CapturedItem& captured) {
            return captured.item->identity() == object->item->identity();
        };
        const auto place = std::find_if(state.items.begin(), state.items.end(), is_its);
        hasher.add(object->name);
        hasher.add(kind_name(object->item->kind()));
        hasher.add(index_of(place - state.items.begin()));
        add_look(hasher, object->look);
    }
    return hasher.value();
}

}  // namespace lissom
