#include "kernel/merge/paste/part/target_piece.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "kernel/merge/piece/put_back.h"
#include "kernel/merge/provenance.h"

namespace lissom {
namespace {

// Rings that sewing takes around a seam, which may run near the border of the chart.
constexpr Index kPieceRings = 8;

// The places that elements of a sewn mesh have in the piece that was opened; none on the side of
// the part.
std::vector<Index> places_in_piece(std::span<const Index> sewn, std::span<const Index> opened) {
    std::vector<Index> places;
    places.reserve(sewn.size());
    for (const Index i : sewn) {
        const bool of_target = i != kNoIndex && i < count_of(opened);
        places.push_back(of_target ? opened[at(i)] : kNoIndex);
    }
    return places;
}

}  // namespace

PasteGround::PasteGround(const Mesh& target, const PasteChart& chart, const Context& context)
    : vertices(chart.map.vertex.size()) {
    std::iota(vertices.begin(), vertices.end(), 0);
    std::vector<Vec3> positions;
    for (const Index v : chart.map.vertex) positions.push_back(target.position(v));
    // A polygon is there once for each of its triangles, one after the other.
    std::vector<Index> faces(chart.map.face.begin(), chart.map.face.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    FaceList list;
    std::vector<Index> face;
    for (const Index f : faces) {
        face.clear();
        for (const Index v : target.topology().face(f)) face.push_back(chart.place_of(v));
        list.add(face);
    }
    mesh = Mesh(std::move(positions), std::move(list), context);
}

TargetPiece::TargetPiece(const Mesh& target, const PasteChart& chart, const Context& context)
    : target_(&target), part_(piece_around(target, chart.map.face, kPieceRings, context)) {
    for (const Index v : chart.map.vertex) {
        const auto place = [&](const std::vector<Index>& ids) {
            return index_of(std::lower_bound(ids.begin(), ids.end(), v) - ids.begin());
        };
        chart_vertices_.push_back(part_ ? place(part_->vertex_map) : v);
    }
}

TargetPiece TargetPiece::whole(const Mesh& target, const PasteChart& chart) {
    TargetPiece piece(target);
    piece.chart_vertices_ = chart.map.vertex;
    return piece;
}

std::optional<PastedOn> TargetPiece::put_back(const OpenedTarget& opened, const PastePart& part,
                                              Sewn sewn, const PasteOrigins& origins,
                                              const Context& context) const {
    const Topology& whole = target_->topology();
    MeshMap map, provenance;
    if (origins.wanted || origins.between) {
        const MeshMap opened_map =
            part_ ? composed(opened.map, part_map(*part_, whole)) : opened.map;
        map =
            composed(sewn.map, appended_map(opened_map, identity_map(part.mesh.topology()), whole));
        provenance = composed_of_two(map, whole, origins.target, part.map, origins.given);
    }
    if (!part_) {
        sewn.map = std::move(map);
        return PastedOn{std::move(sewn), std::move(provenance)};
    }
    const Places places{places_in_piece(sewn.place.vertices, opened.place.vertices),
                        places_in_piece(sewn.place.faces, opened.place.faces)};
    const auto first_source =
        std::find(sewn.side_of_face.begin(), sewn.side_of_face.end(), SeamSide::source);
    const PieceWork work{sewn.mesh, places, sewn.first_source_vertex,
                         index_of(first_source - sewn.side_of_face.begin())};
    if (!keeps_rim(*target_, *part_, work)) return std::nullopt;
    PutBack made = lissom::put_back(*target_, {whole.vertex_count(), whole.face_count()}, *part_,
                                    work, context);
    PastedOn result;
    if (origins.wanted) {
        result.provenance = put_back_map(made, whole, origins.target, sewn.mesh, provenance);
    }
    Sewn& all = result.sewn;
    if (origins.between) all.map = put_back_map(made, whole, nullptr, sewn.mesh, map);
    all.side_of_face.reserve(made.faces.size());
    for (const Index f : made.faces) {
        const Index own = f - whole.face_count();
        all.side_of_face.push_back(own < 0 ? SeamSide::target : sewn.side_of_face[at(own)]);
    }
    const std::vector<Index> number =
        made.numbers_of_work(whole.vertex_count(), sewn.mesh.vertex_count());
    for (std::vector<Index>& seam : sewn.seams) {
        for (Index& v : seam) v = number[at(v)];
    }
    all.mesh = std::move(made.mesh);
    all.seams = std::move(sewn.seams);
    all.report = sewn.report;
    all.first_source_vertex = made.first_source_vertex;
    return result;
}

}  // namespace lissom
