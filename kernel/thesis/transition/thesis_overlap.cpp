#include "kernel/thesis/transition/thesis_overlap.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/merge/provenance.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/thesis/transition/thesis_band.h"

namespace lissom {
namespace {

[[noreturn]] void refuse_overlap(const std::string& what) {
    throw Error(ErrorCode::invalid_argument, "the transition region of the target " + what);
}

// Parts of the faces that are not gone, by edges, and how many there are.
struct FaceParts {
    std::vector<Index> part;
    Index count = 0;
};

FaceParts parts_of_rest(const Topology& topology, const std::vector<char>& gone) {
    std::map<std::pair<Index, Index>, Index> left;
    for (Index f = 0; f < topology.face_count(); ++f) {
        const std::span<const Index> face = topology.face(f);
        for (std::size_t k = 0; !gone[f] && k < face.size(); ++k) {
            left[{face[k], face[(k + 1) % face.size()]}] = f;
        }
    }
    FaceParts result{std::vector<Index>(gone.size(), kNoIndex), 0};
    for (Index first = 0; first < topology.face_count(); ++first) {
        if (gone[first] || result.part[first] != kNoIndex) continue;
        std::vector<Index> front{first};
        result.part[first] = result.count;
        while (!front.empty()) {
            const std::span<const Index> face = topology.face(front.back());
            front.pop_back();
            for (std::size_t k = 0; k < face.size(); ++k) {
                const auto next = left.find({face[(k + 1) % face.size()], face[k]});
                if (next == left.end() || result.part[next->second] != kNoIndex) continue;
                result.part[next->second] = result.count;
                front.push_back(next->second);
            }
        }
        ++result.count;
    }
    return result;
}

// Marks parts that are connected to the rest of the mesh through the regions alone, such as the tip
// of a bump: parts that no far end bounds, of components that have a region.
void take_enclosed(const Topology& topology, std::span<const ThesisRegion> regions,
                   std::vector<char>& gone) {
    const FaceParts rest = parts_of_rest(topology, gone);
    std::vector<char> stays(rest.count, 0), concerned(topology.component_count(), 0);
    for (const ThesisRegion& region : regions) {
        concerned[topology.components()[region.end.front()]] = 1;
        for (std::size_t k = 0; k < region.end.size(); ++k) {
            const Index a = region.end[k], b = region.end[(k + 1) % region.end.size()];
            for (const Index f : topology.faces_around(a)) {
                const std::span<const Index> face = topology.face(f);
                const bool has_edge = std::find(face.begin(), face.end(), b) != face.end();
                if (has_edge && !gone[f]) stays[rest.part[f]] = 1;
            }
        }
    }
    for (Index f = 0; f < topology.face_count(); ++f) {
        if (gone[f] || stays[rest.part[f]]) continue;
        gone[f] = concerned[topology.components()[topology.face(f)[0]]];
    }
}

// A loop of the whole mesh as the boundary that it is on the rest.
std::vector<Index> end_on_rest(const Mesh& rest, const std::vector<Index>& vertex_of,
                               const std::vector<Index>& end) {
    for (const std::vector<Index>& loop : rest.topology().boundary_loops()) {
        if (loop.size() != end.size()) continue;
        const auto start = std::find(end.begin(), end.end(), vertex_of[loop.front()]);
        if (start == end.end()) continue;
        const std::size_t shift = start - end.begin();
        bool same = true;
        for (std::size_t k = 0; k < loop.size(); ++k) {
            same = same && vertex_of[loop[k]] == end[(shift + k) % end.size()];
        }
        if (same) return loop;
    }
    refuse_overlap("touches itself or another at its far end; choose another width");
}

}  // namespace

OpenedForOverlap open_for_overlap(const Mesh& target, std::span<const std::vector<Index>> loops,
                                  double width, const Context& context) {
    const Topology& topology = target.topology();
    std::vector<ThesisRegion> regions;
    std::vector<char> gone(topology.face_count(), 0);
    for (const std::vector<Index>& loop : loops) {
        regions.push_back(make_thesis_region(target, SeamSide::target, loop, width, context));
        for (const Index f : regions.back().faces) {
            if (std::exchange(gone[f], 1)) refuse_overlap("meets that of another join");
        }
    }
    take_enclosed(topology, regions, gone);
    std::vector<Index> kept;
    for (Index f = 0; f < topology.face_count(); ++f) {
        if (!gone[f]) kept.push_back(f);
    }
    MeshPart part = extract_faces(target, kept, context);
    OpenedForOverlap result;
    result.map = part_map(part, topology);
    for (const ThesisRegion& region : regions) {
        result.loops.push_back(end_on_rest(part.mesh, part.vertex_map, region.end));
        std::vector<Index>& end = result.whole.ends.emplace_back();
        for (const Index v : result.loops.back()) end.push_back(part.vertex_map[v]);
    }
    result.mesh = std::move(part.mesh);
    result.whole.mesh = target;
    result.whole.loops.assign(loops.begin(), loops.end());
    result.whole.width = width;
    result.whole.vertex_of = std::move(part.vertex_map);
    return result;
}

}  // namespace lissom
