#include "kernel/mesh/mesh.h"

#include <algorithm>
#include <utility>

#include "kernel/core/nearest.h"
#include "kernel/mesh/region_bytes.h"

namespace lissom {
namespace {

void require_finite(std::span<const Vec3> positions) {
    Elements bad{ElementKind::vertex, 0, {}};
    for (std::size_t v = 0; v < positions.size(); ++v) {
        if (!positions[v].allFinite()) bad.add(index_of(v));
    }
    if (bad.count == 0) return;
    const std::string names = describe(bad);
    throw Error(ErrorCode::not_finite,
                "positions of " + names + " are NaN or infinite; correct them at their source",
                std::move(bad));
}

void require_count(std::size_t count, Index expected) {
    if (count == at(expected)) return;
    throw Error(ErrorCode::invalid_argument, std::to_string(count) + " positions were given for " +
                                                 std::to_string(expected) + " vertices");
}

const std::shared_ptr<const Topology>& empty_topology() {
    static const std::shared_ptr<const Topology> empty = Topology::create(0, {});
    return empty;
}

}  // namespace

Mesh::Mesh() : topology_(empty_topology()) {}

Mesh::Mesh(std::vector<Vec3> positions, FaceList faces, const Context& context)
    : Mesh(std::move(positions), nullptr, context) {
    topology_ = Topology::create(count_of(positions_), std::move(faces), context);
    count();
}

Mesh::Mesh(std::vector<Vec3> positions, std::shared_ptr<const Topology> topology,
           const Context& context)
    : topology_(std::move(topology)) {
    if (topology_) require_count(positions.size(), topology_->vertex_count());
    require_finite(positions);
    context.checkpoint();
    positions_ = std::move(positions);
    if (topology_) count();
}

Mesh& Mesh::operator=(const Mesh& other) {
    return *this = Mesh(other);
}

// Moves as the compiler's own operator does, but attributes bring their account along, and the
// revision is one that this mesh has not had.
Mesh& Mesh::operator=(Mesh&& other) noexcept {
    topology_ = std::move(other.topology_);
    hold_ = std::move(other.hold_);
    positions_ = std::move(other.positions_);
    attributes_.swap(other.attributes_);
    regions_ = std::move(other.regions_);
    material_libraries_ = std::move(other.material_libraries_);
    asset_ = std::move(other.asset_);
    report_ = std::move(other.report_);
    revision_ = std::max(revision_, other.revision_) + 1;
    return *this;
}

void Mesh::count() {
    hold_ = MemoryHold(topology_->account(), "a mesh");
    hold_.resize(positions_.size() * sizeof(Vec3));
    attributes_.count_on(topology_->account());
}

void Mesh::set_position(Index v, const Vec3& position) {
    if (v < 0 || v >= vertex_count()) {
        throw Error(ErrorCode::out_of_range,
                    "vertex " + std::to_string(v) + " is not one of the " +
                        std::to_string(vertex_count()) + " of the mesh",
                    {ElementKind::vertex, 1, {v}});
    }
    if (!position.allFinite()) {
        throw Error(ErrorCode::not_finite,
                    "the position for vertex " + std::to_string(v) + " is NaN or infinite",
                    {ElementKind::vertex, 1, {v}});
    }
    positions_[v] = position;
    ++revision_;
}

void Mesh::set_positions(std::vector<Vec3> positions) {
    require_count(positions.size(), vertex_count());
    require_finite(positions);
    positions_ = std::move(positions);
    ++revision_;
}

std::span<Vec3> Mesh::edit_positions() {
    ++revision_;
    return positions_;
}

void Mesh::replace_by(Mesh other) {
    *this = std::move(other);
}

void Mesh::set_asset(std::shared_ptr<const Asset> asset) {
    if (asset) asset->count_on(topology_->account());
    asset_ = std::move(asset);
}

void Mesh::set_region(std::string_view name, const Region& region) {
    require_same_topology(*this, region.topology(), "the region");
    if (name.empty()) throw Error(ErrorCode::invalid_argument, "a region needs a name");
    regions_.insert_or_assign(std::string(name), region);
}

const Region* Mesh::find_region(std::string_view name) const {
    const auto found = regions_.find(name);
    return found == regions_.end() ? nullptr : &found->second;
}

const Region& Mesh::region(std::string_view name) const {
    if (const Region* found = find_region(name)) return *found;
    std::vector<std::string_view> names;
    for (const auto& entry : regions_) names.push_back(entry.first);
    throw Error(ErrorCode::out_of_range,
                "the mesh has no region '" + std::string(name) + "'" +
                    (names.empty() ? ", nor any other" : name_hint(name, names)));
}

bool Mesh::remove_region(std::string_view name) {
    const auto found = regions_.find(name);
    if (found == regions_.end()) return false;
    regions_.erase(found);
    return true;
}

std::size_t Mesh::memory_bytes() const {
    std::size_t bytes = topology_->memory_bytes() + positions_.size() * sizeof(Vec3);
    for (const auto& [name, region] : regions_) {
        bytes += kRegionBytes + region.vertices().size() * sizeof(Index);
    }
    return bytes + attributes_.memory_bytes();
}

Index element_count(const Topology& topology, Domain domain) {
    if (domain == Domain::vertex) return topology.vertex_count();
    return domain == Domain::corner ? topology.corner_count() : topology.face_count();
}

void require_complete_attributes(const Mesh& mesh) {
    const auto require = [](const std::string& name, std::size_t has, std::size_t needs) {
        if (has == needs) return;
        throw Error(ErrorCode::invalid_argument, name + " has " + std::to_string(has) +
                                                     " values; the mesh needs " +
                                                     std::to_string(needs));
    };
    for (const Attribute& a : mesh.attributes().all()) {
        const std::size_t elements = element_count(mesh.topology(), a.domain);
        require("the attribute \"" + a.name + '"', a.values.size(), elements * a.width);
    }
    for (const auto& [kind, labels] : mesh.attributes().labels()) {
        require("the list of labels \"" + kind + '"', labels.of_face.size(), mesh.face_count());
    }
}

void require_same_topology(const Mesh& mesh, const std::shared_ptr<const Topology>& topology,
                           std::string_view what) {
    if (mesh.shared_topology() == topology) return;
    throw Error(ErrorCode::topology_mismatch,
                std::string(what) +
                    " belongs to another mesh or to an older version of this mesh's topology; make "
                    "it again on the mesh as it is now");
}

}  // namespace lissom
