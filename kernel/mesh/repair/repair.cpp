#include "kernel/mesh/repair/repair.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "kernel/mesh/corner_faces.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/measure/orientation.h"
#include "kernel/mesh/repair/carry_soup.h"
#include "kernel/mesh/repair/face_cleaning.h"
#include "kernel/mesh/repair/quality.h"
#include "kernel/mesh/repair/welding.h"
#include "kernel/mesh/topology_check.h"
#include "kernel/mesh/value_pool.h"

namespace lissom {
namespace {

void require_indices(const Soup& soup) {
    const auto count = count_of(soup.positions);
    Elements bad{ElementKind::face, 0, {}};
    for (Index f = 0; f < soup.faces.size(); ++f) {
        const std::span<const Index> face = soup.faces[f];
        if (std::any_of(face.begin(), face.end(), [&](Index v) { return v < 0 || v >= count; }))
            bad.add(f);
    }
    if (bad.count == 0) return;
    refuse(ErrorCode::face_index, std::move(bad),
           "vertices outside the " + std::to_string(count) + " given are used by",
           "correct the indices");
}

void require_finite(const Soup& soup) {
    Elements bad{ElementKind::vertex, 0, {}};
    for (std::size_t v = 0; v < soup.positions.size(); ++v) {
        if (!soup.positions[v].allFinite()) bad.add(index_of(v));
    }
    if (bad.count == 0) return;
    refuse(ErrorCode::not_finite, std::move(bad), "NaN or infinite are the positions of",
           "correct them at their source");
}

// Lets every face use the first of the vertices that lie at one place.
void weld_all(Soup& soup) {
    ValuePool<3> places;
    std::vector<Index> first_at, first(soup.positions.size());
    for (std::size_t v = 0; v < soup.positions.size(); ++v) {
        const Vec3& p = soup.positions[v];
        const Index place = places.add({p.x(), p.y(), p.z()});
        if (place == count_of(first_at)) first_at.push_back(index_of(v));
        first[v] = first_at[place];
    }
    for (Index& v : soup.faces.vertices) v = first[v];
}

// Joins the vertices of which the file says that they are one.
void weld_known(Soup& soup) {
    if (soup.same_as.empty()) return;
    for (Index& v : soup.faces.vertices) v = soup.same_as[v];
}

// A face that shares no vertex with another has no seam along which its own coincident corners
// could be welded. Its coincident corners become one here, which shows it as collapsed.
void weld_within_loose_faces(Soup& soup) {
    std::vector<Index> uses(soup.positions.size(), 0);
    for (const Index v : soup.faces.vertices) ++uses[v];
    for (Index f = 0; f < soup.faces.size(); ++f) {
        const auto begin = soup.faces.vertices.begin() + soup.faces.offsets[f];
        const auto end = soup.faces.vertices.begin() + soup.faces.offsets[f + 1];
        if (std::any_of(begin, end, [&](Index v) { return uses[v] > 1; })) continue;
        for (auto v = begin; v != end; ++v) {
            const auto next = v + 1 == end ? begin : v + 1;
            if (soup.positions[*v] == soup.positions[*next]) *next = *v;
        }
    }
}

std::vector<char> used_vertices(const Soup& soup, std::span<const Index> corners) {
    std::vector<char> used(soup.positions.size(), 0);
    for (const Index v : corners) used[v] = 1;
    return used;
}

void require_sound(const Soup& soup, std::span<const Index> file_corners, bool keeps_unused,
                   const Context& context) {
    check_and_pair_edges(count_of(soup.positions), soup.faces, context);
    if (soup.faces.size() == 0 || keeps_unused) return;
    Elements unused{ElementKind::vertex, 0, {}};
    const std::vector<char> used = used_vertices(soup, file_corners);
    for (std::size_t v = 0; v < used.size(); ++v) {
        if (!used[v]) unused.add(index_of(v));
    }
    if (unused.count == 0) return;
    refuse(ErrorCode::unreferenced_vertex, std::move(unused), "no face uses",
           "load with repair to drop them");
}

void require_area(const Mesh& mesh) {
    Elements flat{ElementKind::face, 0, {}};
    for (const Index f : zero_area_faces(mesh)) flat.add(f);
    if (flat.count == 0) return;
    refuse(ErrorCode::zero_area, std::move(flat), "there is no area in",
           "collapse or remove them, or load with repair to have them flagged only");
}

std::span<const Index> object_labels(const Soup& soup) {
    const auto& labels = soup.attributes.labels();
    const auto objects = labels.find("object");
    if (objects == labels.end()) return {};
    return objects->second.of_face;
}

// Vertices that are neither in the mesh nor welded to one that is.
std::vector<Index> left_out(const Soup& soup, std::span<const Index> file_corners,
                            const CornerFaces& work, const FanVertices& fans) {
    std::vector<char> known = used_vertices(soup, fans.source);
    for (const Index corner : work.corner_source) known[file_corners[corner]] = 1;
    std::vector<Index> list;
    for (std::size_t v = 0; v < known.size(); ++v) {
        if (!known[v]) list.push_back(index_of(v));
    }
    return list;
}

// Gives vertices without faces the place that their number has among the others. The first fans of
// the soup's vertices come in their order, and then further ones.
void insert_vertices(const std::vector<Index>& added, FanVertices& fans) {
    if (added.empty()) return;
    const auto further =
        std::adjacent_find(fans.source.begin(), fans.source.end(), std::greater_equal<>());
    const auto first_count =
        further == fans.source.end() ? fans.source.size() : at(further - fans.source.begin()) + 1;
    std::vector<Index> source, moved_to;
    source.reserve(fans.source.size() + added.size());
    auto next = added.begin();
    for (std::size_t fan = 0; fan < fans.source.size(); ++fan) {
        const bool is_first = fan < first_count;
        while (next != added.end() && (!is_first || *next < fans.source[fan])) {
            source.push_back(*next++);
        }
        moved_to.push_back(count_of(source));
        source.push_back(fans.source[fan]);
    }
    source.insert(source.end(), next, added.end());
    for (Index& fan : fans.of_corner) fan = moved_to[at(fan)];
    fans.source = std::move(source);
    fans.unchanged = false;
}

// Findings about the vertices of the file.
class VertexFindings {
  public:
    VertexFindings(const Soup& soup, std::span<const Index> file_corners, const CornerFaces& work,
                   const FanVertices& fans)
        : soup_(soup), file_corners_(file_corners), work_(work), fans_(fans) {}

    void add_to(Report& report) const {
        if (fans_.unchanged) return;
        add_unused(report);
        add_welded(report);
        add_split(report);
    }

  private:
    void add_unused(Report& report) const {
        const std::vector<char> used = used_vertices(soup_, file_corners_);
        const std::vector<char> kept = used_vertices(soup_, fans_.source);
        std::vector<Index> unused;
        for (std::size_t v = 0; v < used.size(); ++v) {
            if (!used[v] && !kept[v]) unused.push_back(index_of(v));
        }
        add(report, FindingKind::vertices_unreferenced, std::move(unused));
    }

    void add_welded(Report& report) const {
        const std::vector<char> source = used_vertices(soup_, fans_.source);
        std::vector<Index> welded;
        std::vector<char> counted(soup_.positions.size(), 0);
        for (const Index corner : work_.corner_source) {
            const Index v = file_corners_[corner];
            if (!source[v] && !counted[v]) welded.push_back(v);
            counted[v] = 1;
        }
        std::sort(welded.begin(), welded.end());
        add(report, FindingKind::vertices_welded, std::move(welded));
    }

    // Vertices with several fans that are not at the end of an edge that was cut open.
    void add_split(Report& report) const {
        std::vector<char> at_cut(soup_.positions.size(), 0);
        for (const FindingKind kind :
             {FindingKind::edges_nonmanifold, FindingKind::edges_unorientable}) {
            const Finding* cut = report.find(kind);
            for (const Index v : cut ? cut->ids : std::vector<Index>{}) at_cut[v] = 1;
        }
        std::vector<Index> fan_of(soup_.positions.size(), kNoIndex), split;
        for (std::size_t c = 0; c < work_.faces.vertices.size(); ++c) {
            const Index v = work_.faces.vertices[c], fan = fans_.of_corner[c];
            if (fan_of[v] == kNoIndex) fan_of[v] = fan;
            if (fan_of[v] != fan && !at_cut[v]) {
                split.push_back(v);
                at_cut[v] = 1;
            }
        }
        std::sort(split.begin(), split.end());
        add(report, FindingKind::vertices_nonmanifold, std::move(split));
    }

    static void add(Report& report, FindingKind kind, std::vector<Index> ids) {
        const std::size_t count = ids.size();
        if (count > 0) report.add({kind, ElementKind::vertex, true, count, std::move(ids), {}});
    }

    const Soup& soup_;
    std::span<const Index> file_corners_;
    const CornerFaces& work_;
    const FanVertices& fans_;
};

Mesh mesh_without_faces(Soup soup, const Context& context, Report& report) {
    const std::size_t count = soup.positions.size();
    if (count > 0) {
        report.add({FindingKind::points_only, ElementKind::vertex, false, count, {}, {}});
    }
    Mesh mesh(std::move(soup.positions), FaceList{}, context);
    for (Attribute& attribute : soup.attributes.all()) {
        if (attribute.domain == Domain::vertex) mesh.attributes().add(std::move(attribute));
    }
    for (auto& [name, vertices] : soup.regions) {
        mesh.set_region(name, Region(mesh.shared_topology(), std::move(vertices)));
    }
    return mesh;
}

void require_usable(const Soup& soup) {
    require_indices(soup);
    require_finite(soup);
    require_attributes_fit(soup);
}

// Lists by corner and by vertex: welds, matched edges, splits of vertices.
std::size_t working_bytes(const Soup& soup) {
    constexpr std::size_t kBytesPerCorner = 48, kBytesPerVertex = 64;
    return kBytesPerCorner * soup.faces.vertices.size() + kBytesPerVertex * soup.positions.size();
}

void weld_vertices(Soup& soup, Weld weld) {
    weld_known(soup);
    if (weld == Weld::all) weld_all(soup);
    if (weld == Weld::seams) weld_within_loose_faces(soup);
}

// Faces are dropped and turned only if their edges do not fit together as they are.
Welding welded_edges(const std::vector<Vec3>& positions, CornerFaces& work, Report& report) {
    Welding welding(positions, work);
    if (welding.weld_regular_edges()) return welding;
    drop_duplicates(count_of(positions), work, report);
    orient_faces(positions, work, report);
    welding = Welding(positions, work);
    welding.weld_edges(report);
    return welding;
}

}  // namespace

Mesh repair(Soup soup, const RepairOptions& options, const Context& context, Report report) {
    Progress progress(context, "check mesh");
    require_usable(soup);
    const MemoryCharge working = context.charge(working_bytes(soup), "checking a mesh");
    const std::vector<Index> file_corners = soup.faces.vertices;
    const bool keeps_unused = options.unused == UnusedVertices::keep;
    weld_vertices(soup, options.weld);
    if (!options.repair) require_sound(soup, file_corners, keeps_unused, context);
    progress.update(0.2);

    CornerFaces work(std::move(soup.faces));
    clean_faces(work, report);
    if (work.faces.size() == 0) {
        Mesh points = mesh_without_faces(std::move(soup), context, report);
        points.set_report(std::move(report));
        return points;
    }
    Welding welding = welded_edges(soup.positions, work, report);
    progress.update(0.5);

    if (options.weld == Weld::seams && !welding.is_closed())
        welding.weld_seams(object_labels(soup));
    FanVertices fans = welding.number_fans();
    if (keeps_unused) insert_vertices(left_out(soup, file_corners, work, fans), fans);
    VertexFindings(soup, file_corners, work, fans).add_to(report);
    progress.update(0.8);

    Mesh mesh = carry_soup(std::move(soup), file_corners, std::move(work), std::move(fans),
                           welding.twin(), context);
    if (!options.repair) require_area(mesh);
    flag_quality(mesh, report);
    mesh.set_report(std::move(report));
    return mesh;
}

}  // namespace lissom
