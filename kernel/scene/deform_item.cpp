#include "kernel/scene/deform_item.h"

#include "kernel/core/hasher.h"
#include "kernel/deform/description.h"

namespace lissom {
namespace {

void add(Hasher& hasher, const Vec3& v) {
    for (const double x : v) hasher.add(x);
}

void add(Hasher& hasher, const std::vector<Vec3>& list) {
    hasher.add(count_of(list));
    for (const Vec3& v : list) add(hasher, v);
}

void add(Hasher& hasher, const Affine& map) {
    for (const double x : map.linear.reshaped()) hasher.add(x);
    add(hasher, map.translation);
}

void add(Hasher& hasher, const std::optional<double>& value) {
    hasher.add(value.has_value());
    hasher.add(value.value_or(0.0));
}

void add(Hasher& hasher, const MeshPoint& point) {
    hasher.add(point.vertices);
    hasher.add(point.weights);
}

void add(Hasher& hasher, const DeformOptions& o) {
    for (const int choice :
         {static_cast<int>(o.method), static_cast<int>(o.second), static_cast<int>(o.local_size),
          static_cast<int>(o.weights), static_cast<int>(o.flat), static_cast<int>(o.loose),
          o.free_rings, o.refine, o.coherence}) {
        hasher.add(Index{choice});
    }
    for (const double number :
         {o.coherence_weight, o.degenerate_threshold, o.displacement, o.transition}) {
        hasher.add(number);
    }
    if (o.volume != 0.0) hasher.add(o.volume);
    if (o.level_vertices != 0) hasher.add(o.level_vertices);
    hasher.add(o.subdivide_borders);
    hasher.add(o.scale_free);
}

// Ids are history; a mirror image is named by its place among the handles that there are.
void add(Hasher& hasher, const HandleDescription& handle, Index partner) {
    hasher.add(handle.vertices);
    hasher.add(count_of(handle.points));
    for (const MeshPoint& point : handle.points) add(hasher, point);
    hasher.add(handle.options.position);
    hasher.add(handle.options.gradient);
    add(hasher, handle.options.weight);
    hasher.add(handle.options.falloff);
    hasher.add(partner);
    if (partner != kNoIndex) {
        add(hasher, handle.mirror.point);
        add(hasher, handle.mirror.normal);
        hasher.add(handle.mirror.tolerance);
    }
    add(hasher, handle.pose.transform);
    add(hasher, handle.pose.local_transform);
    add(hasher, handle.pose.turn);
}

void add(Hasher& hasher, const PointConstraint& constraint) {
    add(hasher, constraint.point);
    hasher.add(constraint.position.has_value());
    if (constraint.position) add(hasher, *constraint.position);
    hasher.add(constraint.gradient.has_value());
    if (constraint.gradient) add(hasher, Affine{*constraint.gradient, Vec3::Zero()});
    add(hasher, constraint.weight);
}

void add_handles(Hasher& hasher, const DeformDescription& description) {
    std::vector<Index> place;
    Index count = 0;
    for (const auto& handle : description.handles) place.push_back(handle ? count++ : kNoIndex);
    hasher.add(count);
    for (const auto& handle : description.handles) {
        if (!handle) continue;
        add(hasher, *handle, handle->partner ? place[at(handle->partner->value)] : kNoIndex);
    }
    for (const Bones& bones : description.bones) {
        for (const HandleId id : bones.handles) hasher.add(place[at(id.value)]);
        for (const Vec3& joint : bones.joints) add(hasher, joint);
        hasher.add(bones.limits);
    }
}

}  // namespace

DeformContent::DeformContent(Deformer& deformer, ContentStore& store)
    : DeformContent(deformer.snapshot(), store) {}

DeformContent::DeformContent(DeformSnapshot snapshot, ContentStore& store) {
    rest_ = store.keep_counted(snapshot.rest, lissom::memory_bytes(*snapshot.rest));
    constraints_ = store.keep(snapshot.constraints, lissom::memory_bytes(*snapshot.constraints));
    shown_ = store.keep(snapshot.shown, lissom::memory_bytes(*snapshot.shown));
    poses_ = std::move(snapshot.poses);
    count_own(store, sizeof *this + poses_.handles.size() * sizeof poses_.handles[0] +
                         poses_.targets.size() * sizeof poses_.targets[0]);
}

bool DeformContent::operator==(const DeformContent& other) const {
    return rest_ == other.rest_ && constraints_ == other.constraints_ && poses_ == other.poses_ &&
           shown_ == other.shown_;
}

void DeformContent::list_kept(std::vector<const KeptBytes*>& list) const {
    list.insert(list.end(), {rest_.get(), constraints_.get(), shown_.get()});
}

std::uint64_t DeformContent::compute_hash() const {
    Hasher hasher;
    const RestShape& rest = *rest_->value;
    hasher.add(region_of(rest).vertices());
    add(hasher, options_of(rest));
    add(hasher, positions_of(rest));
    const DeformDescription description = describe(snapshot());
    add_handles(hasher, description);
    hasher.add(count_of(description.constraints));
    for (const PointConstraint& constraint : description.constraints) add(hasher, constraint);
    hasher.add(description.stiffness);
    if (description.volume) hasher.add(*description.volume);
    add(hasher, shown_->value->positions);
    return hasher.value();
}

std::shared_ptr<const ItemContent> DeformItem::capture(
    const std::shared_ptr<const ItemContent>& last, ContentStore& store) const {
    auto content = std::make_shared<const DeformContent>(*deformer_, store);
    const auto* before = dynamic_cast<const DeformContent*>(last.get());
    if (before && *content == *before) return last;
    return content;
}

void DeformItem::restore(const ItemContent& content, const ItemContent*) {
    const auto& wanted = dynamic_cast<const DeformContent&>(content);
    deformer_->restore(wanted.snapshot());
    restored();
}

}  // namespace lissom
