#include "kernel/scene/mesh_item.h"

#include <algorithm>
#include <utility>

#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

template <typename List>
std::size_t bytes_in(const List& list) {
    return list.size() * sizeof(typename List::value_type);
}

std::size_t size_in_bytes(const std::map<std::string, FaceLabels, std::less<>>& labels) {
    std::size_t bytes = 0;
    for (const auto& [kind, of_kind] : labels) {
        bytes += kind.size() + bytes_in(of_kind.of_face);
        for (const std::string& name : of_kind.names) bytes += sizeof(std::string) + name.size();
    }
    return bytes;
}

std::size_t size_in_bytes(const std::map<std::string, Region, std::less<>>& regions) {
    std::size_t bytes = 0;
    for (const auto& [name, region] : regions) bytes += name.size() + bytes_in(region.vertices());
    return bytes;
}

std::size_t size_in_bytes(const Report& report) {
    std::size_t bytes = 0;
    for (const Finding& finding : report.findings()) {
        bytes += sizeof finding + finding.message.size() + bytes_in(finding.ids);
    }
    return bytes;
}

// Returns the kept copy of `value`, that of `last` if it is the same.
template <typename T>
std::shared_ptr<const Kept<T>> keep_equal(const T& value,
                                          const std::shared_ptr<const Kept<T>>* last,
                                          ContentStore& store) {
    if (last && *(*last)->value == value) return *last;
    return store.keep(std::make_shared<const T>(value), size_in_bytes(value));
}

// Regions count themselves.
using Regions = std::map<std::string, Region, std::less<>>;

std::shared_ptr<const Kept<Regions>> keep_regions(const Regions& regions,
                                                  const std::shared_ptr<const Kept<Regions>>* last,
                                                  ContentStore& store) {
    if (last && *(*last)->value == regions) return *last;
    return store.keep_counted(std::make_shared<const Regions>(regions), size_in_bytes(regions));
}

bool same_form(const Attribute& a, const Attribute& b) {
    return a.name == b.name && a.domain == b.domain && a.width == b.width && a.type == b.type;
}

Attribute form_of(const Attribute& attribute) {
    return {attribute.name, attribute.domain, attribute.width, attribute.type, {}};
}

}  // namespace

MeshContent::MeshContent(const Mesh& mesh, const MeshContent* last, bool same_positions,
                         ContentStore& store)
    : topology_(store.keep_counted(mesh.shared_topology(), mesh.topology().memory_bytes())),
      positions_(same_positions ? last->positions_
                                : SharedBlocks(std::as_bytes(mesh.positions()),
                                               last ? last->positions_ : SharedBlocks(), store)),
      labels_(keep_equal(mesh.attributes().labels(), last ? &last->labels_ : nullptr, store)),
      regions_(keep_regions(mesh.regions(), last ? &last->regions_ : nullptr, store)),
      asset_(store.keep_counted(mesh.asset(), mesh.asset() ? mesh.asset()->memory_bytes() : 0)),
      report_(keep_equal(mesh.report(), last ? &last->report_ : nullptr, store)),
      material_libraries_(mesh.material_libraries()) {
    for (const Attribute& attribute : mesh.attributes().all()) {
        const std::size_t i = attributes_.size();
        const bool known = last && i < last->attributes_.size();
        attributes_.push_back({form_of(attribute),
                               {byte_view(attribute.values),
                                known ? last->attributes_[i].values : SharedBlocks(), store}});
    }
    count_own(store, own_bytes());
}

std::size_t MeshContent::own_bytes() const {
    std::size_t bytes = sizeof *this + positions_.list_bytes();
    for (const AttributeContent& attribute : attributes_) {
        bytes += sizeof attribute + attribute.form.name.size() + attribute.values.list_bytes();
    }
    for (const std::string& library : material_libraries_) {
        bytes += sizeof(std::string) + library.size();
    }
    return bytes;
}

bool MeshContent::same_form(const MeshContent& other) const {
    const auto same = [](const AttributeContent& a, const AttributeContent& b) {
        return lissom::same_form(a.form, b.form) && a.values.size() == b.values.size();
    };
    return topology_ == other.topology_ && labels_ == other.labels_ && regions_ == other.regions_ &&
           asset_ == other.asset_ && report_ == other.report_ &&
           material_libraries_ == other.material_libraries_ &&
           std::equal(attributes_.begin(), attributes_.end(), other.attributes_.begin(),
                      other.attributes_.end(), same);
}

bool MeshContent::operator==(const MeshContent& other) const {
    const auto same = [](const AttributeContent& a, const AttributeContent& b) {
        return a.values == b.values;
    };
    return same_form(other) && positions_ == other.positions_ &&
           std::equal(attributes_.begin(), attributes_.end(), other.attributes_.begin(), same);
}

// Positions are written behind the mesh's checks: the old ones come back, even invalid ones.
Mesh MeshContent::mesh() const {
    std::vector<Vec3> zeros(at(topology().vertex_count()), Vec3::Zero());
    Mesh mesh(std::move(zeros), topology_->value);
    positions_.copy_to(std::as_writable_bytes(mesh.edit_positions()));
    for (const AttributeContent& content : attributes_) {
        Attribute attribute = content.form;
        attribute.values.resize(content.values.size() / sizeof(double));
        content.values.copy_to(std::as_writable_bytes(std::span(attribute.values)));
        mesh.attributes().add(std::move(attribute));
    }
    mesh.attributes().labels() = *labels_->value;
    mesh.attributes().recount();
    for (const auto& [name, region] : *regions_->value) mesh.set_region(name, region);
    mesh.material_libraries() = material_libraries_;
    mesh.set_asset(asset_ ? asset_->value : nullptr);
    mesh.set_report(*report_->value);
    return mesh;
}

bool MeshContent::write_numbers(Mesh& mesh, const MeshContent& present) const {
    if (!same_form(present)) return false;
    positions_.copy_changes_to(std::as_writable_bytes(mesh.edit_positions()), present.positions_);
    for (std::size_t i = 0; i < attributes_.size(); ++i) {
        attributes_[i].values.copy_changes_to(
            std::as_writable_bytes(std::span(mesh.attributes().all()[i].values)),
            present.attributes_[i].values);
    }
    return true;
}

void MeshContent::list_kept(std::vector<const KeptBytes*>& list) const {
    positions_.list_kept(list);
    for (const AttributeContent& attribute : attributes_) attribute.values.list_kept(list);
    for (const KeptBytes* kept : std::initializer_list<const KeptBytes*>{
             topology_.get(), labels_.get(), regions_.get(), asset_.get(), report_.get()}) {
        if (kept) list.push_back(kept);
    }
}

std::uint64_t MeshContent::compute_hash() const {
    return lissom::hash(mesh());
}

std::shared_ptr<const ItemContent> MeshItem::capture(const std::shared_ptr<const ItemContent>& last,
                                                     ContentStore& store) const {
    const auto* before = dynamic_cast<const MeshContent*>(last.get());
    const bool same_positions =
        before && last == captured_.lock() && mesh_->revision() == revision_;
    std::shared_ptr<const ItemContent> now = last;
    auto content = std::make_shared<const MeshContent>(*mesh_, before, same_positions, store);
    if (!before || !(*content == *before)) now = std::move(content);
    captured_ = now;
    revision_ = mesh_->revision();
    return now;
}

void MeshItem::restore(const ItemContent& content, const ItemContent* present) {
    const auto& wanted = dynamic_cast<const MeshContent&>(content);
    const auto* now = dynamic_cast<const MeshContent*>(present);
    if (!now || !wanted.write_numbers(*mesh_, *now)) mesh_->replace_by(wanted.mesh());
    restored();
}

}  // namespace lissom
