#include "kernel/mesh/resample/triangle_editor.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <utility>

#include "kernel/mesh/resample/disjoint_sets.h"

namespace lissom {
namespace {

// Cosine of the angle by which a triangle may turn, about 78 degrees.
constexpr double kLeastCosine = 0.2;
// Area over squared longest edge below which triangles must not fall.
constexpr double kLeastShape = 0.02;

Vec3 area_vector(const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b - a).cross(c - a);
}

// Faces around a vertex beyond which its neighbours are sorted, not searched one by one.
constexpr std::size_t kHubFaces = 64;

void keep_first_of_equals(std::vector<Index>& numbers) {
    std::vector<std::pair<Index, std::size_t>> places;
    for (std::size_t i = 0; i < numbers.size(); ++i) places.emplace_back(numbers[i], i);
    std::sort(places.begin(), places.end());
    const auto end = std::unique(places.begin(), places.end(),
                                 [](const auto& a, const auto& b) { return a.first == b.first; });
    places.erase(end, places.end());
    std::sort(places.begin(), places.end(),
              [](const auto& a, const auto& b) { return a.second < b.second; });
    numbers.clear();
    for (const auto& [number, place] : places) numbers.push_back(number);
}

// Returns how many numbers are in both lists, none of which has one twice. Changes their order if
// they are long.
std::size_t common_count(std::vector<Index>& a, std::vector<Index>& b) {
    if (a.size() > kHubFaces || b.size() > kHubFaces) {
        std::sort(a.begin(), a.end());
        std::sort(b.begin(), b.end());
        std::vector<Index> both;
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
        return both.size();
    }
    return at(std::count_if(b.begin(), b.end(),
                            [&](Index u) { return std::find(a.begin(), a.end(), u) != a.end(); }));
}

double shape_of(const Vec3& area, const Vec3& a, const Vec3& b, const Vec3& c) {
    const double longest =
        std::max({(a - b).squaredNorm(), (b - c).squaredNorm(), (c - a).squaredNorm()});
    return longest > 0.0 ? area.norm() / longest : 0.0;
}

}  // namespace

TriangleEditor::TriangleEditor(const Mesh& mesh, const std::vector<char>& lines)
    : positions_(mesh.positions().begin(), mesh.positions().end()),
      moved_(positions_.size(), 0),
      held_(positions_.size(), 0),
      line_counts_(positions_.size(), 0),
      fans_(positions_.size()),
      face_count_(mesh.face_count()) {
    const Topology& topology = mesh.topology();
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const std::span<const Index> fan = topology.faces_around(v);
        fans_[at(v)].assign(fan.begin(), fan.end());
        vertex_sources_.push_back({{v, 1.0}});
    }
    for (Index f = 0; f < mesh.face_count(); ++f) {
        Face face;
        face.origin = f;
        for (std::size_t k = 0; k < 3; ++k) {
            face.vertices[k] = topology.face(f)[k];
            face.sectors[k] = kNoIndex;
            face.lines[k] = lines[at(topology.first_corner(f)) + k];
        }
        faces_.push_back(face);
    }
    make_sectors();
    find_charts();
}

// Faces of one sector are in one chart.
void TriangleEditor::find_charts() {
    DisjointSets sets(face_count_);
    std::vector<Index> first(sector_sources_.size(), kNoIndex);
    for (Index f = 0; f < face_count_; ++f) {
        for (const Index sector : faces_[at(f)].sectors) {
            if (first[at(sector)] == kNoIndex) first[at(sector)] = f;
            sets.join(first[at(sector)], f);
        }
    }
    charts_ = sets.numbers();
}

// The faces around a vertex follow each other; a line between two of them begins a new sector.
void TriangleEditor::make_sectors() {
    for (Index v = 0; v < count_of(fans_); ++v) {
        const std::vector<Index>& fan = fans_[at(v)];
        if (fan.empty()) continue;
        const auto begins = [&](std::size_t i) {
            const Face& face = faces_[at(fan[i])];
            return face.lines[at(place_of(face, v))] != 0;
        };
        std::size_t first = 0;
        while (first < fan.size() && !begins(first)) ++first;
        if (first == fan.size()) first = 0;
        for (std::size_t i = 0; i < fan.size(); ++i) {
            const std::size_t now = (first + i) % fan.size();
            Face& face = faces_[at(fan[now])];
            const Index k = place_of(face, v);
            if (begins(now)) ++line_counts_[at(v)];
            if (i == 0 || begins(now)) sector_sources_.push_back({{3 * fan[now] + k, 1.0}});
            face.sectors[at(k)] = count_of(sector_sources_) - 1;
        }
        // The edge that ends an open fan begins no sector.
        const Face& last = faces_[at(fan[(first + fan.size() - 1) % fan.size()])];
        const std::size_t before = at((place_of(last, v) + 2) % 3);
        const bool open = edge(last.vertices[before], v).right == kNoIndex;
        if (open) ++line_counts_[at(v)];
    }
}

void TriangleEditor::move(Index v, const Vec3& position) {
    positions_[at(v)] = position;
    moved_[at(v)] = 1;
}

void TriangleEditor::hold_outside(const Region& region) {
    const std::vector<char> inside = region.mask();
    for (const Face& face : faces_) {
        const bool all = std::all_of(face.vertices.begin(), face.vertices.end(),
                                     [&](Index v) { return inside[at(v)] != 0; });
        if (all) continue;
        for (const Index v : face.vertices) hold(v);
    }
}

Index TriangleEditor::place_of(const Face& face, Index v) {
    return face.vertices[0] == v ? 0 : face.vertices[1] == v ? 1 : 2;
}

TriangleEditor::Edge TriangleEditor::edge(Index a, Index b) const {
    // A hub of very many faces is met from the other end.
    if (fans_[at(b)].size() < fans_[at(a)].size()) {
        const Edge back = edge_from(b, a);
        return {a, b, back.right, back.left, back.on_line};
    }
    return edge_from(a, b);
}

TriangleEditor::Edge TriangleEditor::edge_from(Index a, Index b) const {
    Edge edge{a, b};
    for (const Index f : fans_[at(a)]) {
        const Face& face = faces_[at(f)];
        const std::size_t k = at(place_of(face, a));
        if (face.vertices[(k + 1) % 3] == b) {
            edge.left = f;
            edge.on_line = edge.on_line || face.lines[k] != 0;
        } else if (face.vertices[(k + 2) % 3] == b) {
            edge.right = f;
            edge.on_line = edge.on_line || face.lines[(k + 2) % 3] != 0;
        }
    }
    return edge;
}

void TriangleEditor::neighbors(Index v, std::vector<Index>& result) const {
    const bool is_hub = fans_[at(v)].size() > kHubFaces;
    result.clear();
    for (const Index f : fans_[at(v)]) {
        const Face& face = faces_[at(f)];
        const std::size_t k = at(place_of(face, v));
        for (const std::size_t step : {1u, 2u}) {
            const Index u = face.vertices[(k + step) % 3];
            const bool is_new =
                is_hub || std::find(result.begin(), result.end(), u) == result.end();
            if (is_new) result.push_back(u);
        }
    }
    if (is_hub) keep_first_of_equals(result);
}

Index TriangleEditor::opposite(Index face, const Edge& edge) const {
    for (const Index v : faces_[at(face)].vertices) {
        if (v != edge.a && v != edge.b) return v;
    }
    return kNoIndex;
}

Index TriangleEditor::sector_at(Index face, Index v) const {
    return faces_[at(face)].sectors[at(place_of(faces_[at(face)], v))];
}

// The link condition (Dey, Edelsbrunner, Guha and Nekhayev 1999), and lines merge along lines.
bool TriangleEditor::can_collapse(const Edge& edge) const {
    if (!is_inner(edge.b) && !(is_on_line(edge.b) && edge.on_line)) return false;
    neighbors(edge.a, scratch_a_);
    neighbors(edge.b, scratch_b_);
    const std::size_t common = common_count(scratch_a_, scratch_b_);
    std::size_t sides = 0;
    for (const Index f : {edge.left, edge.right}) {
        if (f == kNoIndex) continue;
        ++sides;
        const Face& face = faces_[at(f)];
        if (face.lines[0] && face.lines[1] && face.lines[2]) return false;
        const Index tip = opposite(f, edge);
        const std::size_t faces = fan(tip).size();
        if (faces >= 4) continue;
        neighbors(tip, scratch_a_);
        const bool open = faces < scratch_a_.size();
        if (faces < (open ? 2u : 4u)) return false;
    }
    return common == sides && sides > 0;
}

void TriangleEditor::remove_from_fan(Index v, Index face) {
    std::vector<Index>& fan = fans_[at(v)];
    fan.erase(std::find(fan.begin(), fan.end(), face));
}

void TriangleEditor::retarget(Index face, Index from, Index to, Index sector) {
    Face& changed = faces_[at(face)];
    const std::size_t k = at(place_of(changed, from));
    changed.vertices[k] = to;
    changed.sectors[k] = sector;
}

// The two other edges of a removed face become one: it is on a line if one of them was.
void TriangleEditor::merge_lines(Index removed, const Edge& edge) {
    const Index tip = opposite(removed, edge);
    const Edge of_a = this->edge(edge.a, tip), of_b = this->edge(edge.b, tip);
    line_counts_[at(tip)] -= of_a.on_line && of_b.on_line ? 1 : 0;
    line_counts_[at(edge.a)] -= of_a.on_line && of_b.on_line ? 1 : 0;
    if (!of_a.on_line && !of_b.on_line) return;
    for (const auto& [side, from] : {std::pair(of_a, edge.a), std::pair(of_b, edge.b)}) {
        for (const Index f : {side.left, side.right}) {
            if (f == kNoIndex || f == removed) continue;
            Face& face = faces_[at(f)];
            const std::size_t k = at(place_of(face, from));
            face.lines[face.vertices[(k + 1) % 3] == tip ? k : (k + 2) % 3] = 1;
        }
    }
}

void TriangleEditor::collapse(const Edge& edge) {
    const Index a = edge.a, b = edge.b;
    const bool has_left = edge.left != kNoIndex, has_right = edge.right != kNoIndex;
    const Index b_left = has_left ? sector_at(edge.left, b) : kNoIndex;
    const Index a_left = sector_at(has_left ? edge.left : edge.right, a);
    const Index a_right = sector_at(has_right ? edge.right : edge.left, a);
    // The lines of b other than the edge itself come to a, in place of the edge.
    line_counts_[at(a)] += line_counts_[at(b)] - (edge.on_line ? 2 : 0);
    for (const Index f : {edge.left, edge.right}) {
        if (f != kNoIndex) merge_lines(f, edge);
    }
    for (const Index f : {edge.left, edge.right}) {
        if (f == kNoIndex) continue;
        for (const Index v : faces_[at(f)].vertices) remove_from_fan(v, f);
        faces_[at(f)].origin = kNoIndex;
        --face_count_;
    }
    for (const Index f : fans_[at(b)]) {
        retarget(f, b, a, sector_at(f, b) == b_left ? a_left : a_right);
        fans_[at(a)].push_back(f);
    }
    fans_[at(b)] = {};
}

bool TriangleEditor::turns_faces(Index v, Index other, const Vec3& place) const {
    for (const Index f : fan(v)) {
        const Face& face = faces_[at(f)];
        const std::size_t k = at(place_of(face, v));
        const Index next = face.vertices[(k + 1) % 3], last = face.vertices[(k + 2) % 3];
        if (next == other || last == other) continue;
        const Vec3 &p = position(next), &q = position(last);
        const Vec3 before = area_vector(position(v), p, q), after = area_vector(place, p, q);
        if (after.dot(before) < kLeastCosine * after.norm() * before.norm()) return true;
        const double shape = shape_of(after, place, p, q);
        if (shape < std::min(kLeastShape, 0.5 * shape_of(before, position(v), p, q))) return true;
    }
    return false;
}

TriangleEditor::Sources TriangleEditor::blended(const Sources& a, const Sources& b) const {
    Sources result;
    for (const Sources* sources : {&a, &b}) {
        for (const ElementMap::Source& s : *sources) {
            const auto same = std::find_if(result.begin(), result.end(),
                                           [&](const auto& r) { return r.element == s.element; });
            if (same == result.end()) {
                result.push_back({s.element, 0.5 * s.weight});
            } else {
                same->weight += 0.5 * s.weight;
            }
        }
    }
    return result;
}

Index TriangleEditor::split_sector(Index face, const Edge& edge) {
    sector_sources_.push_back(edge.on_line ? blended(sector_sources_[at(sector_at(face, edge.a))],
                                                     sector_sources_[at(sector_at(face, edge.b))])
                                           : Sources{});
    return count_of(sector_sources_) - 1;
}

// The face keeps the half at `edge.a`.
void TriangleEditor::split_face(Index face, const Edge& edge, Index middle, Index sector) {
    Face half = faces_[at(face)];
    const Index tip = opposite(face, edge);
    const std::size_t b = at(place_of(half, edge.b)), a = at(place_of(half, edge.a));
    Face& kept = faces_[at(face)];
    kept.vertices[b] = half.vertices[a] = middle;
    kept.sectors[b] = half.sectors[a] = sector;
    // The new edge between the middle and the tip is on no line.
    const std::size_t t = at(place_of(kept, tip));
    kept.lines[(b + 1) % 3 == t ? b : t] = 0;
    half.lines[(a + 1) % 3 == t ? a : t] = 0;
    const Index added = count_of(faces_);
    faces_.push_back(half);
    ++face_count_;
    remove_from_fan(edge.b, face);
    fans_[at(edge.b)].push_back(added);
    fans_[at(tip)].push_back(added);
    fans_[at(middle)].push_back(face);
    fans_[at(middle)].push_back(added);
}

Index TriangleEditor::split(const Edge& edge) {
    const Index middle = count_of(positions_);
    positions_.push_back(0.5 * (position(edge.a) + position(edge.b)));
    moved_.push_back(edge.on_line ? 0 : 1);
    held_.push_back(0);
    line_counts_.push_back(edge.on_line ? 2 : 0);
    fans_.emplace_back();
    vertex_sources_.push_back(
        edge.on_line ? blended(vertex_sources_[at(edge.a)], vertex_sources_[at(edge.b)])
                     : Sources{});
    Index sector = kNoIndex;
    for (const Index f : {edge.left, edge.right}) {
        if (f == kNoIndex) continue;
        if (sector == kNoIndex || edge.on_line) sector = split_sector(f, edge);
        split_face(f, edge, middle, sector);
    }
    return middle;
}

bool TriangleEditor::can_flip(const Edge& edge) const {
    if (edge.on_line || edge.left == kNoIndex || edge.right == kNoIndex) return false;
    const Index c = opposite(edge.left, edge), d = opposite(edge.right, edge);
    if (c == d || fan(edge.a).size() < 4 || fan(edge.b).size() < 4) return false;
    const Edge other = this->edge(c, d);
    return other.left == kNoIndex && other.right == kNoIndex;
}

// Triangles a b c and b a d become c d b and d c a.
void TriangleEditor::flip(const Edge& edge) {
    const Index c = opposite(edge.left, edge), d = opposite(edge.right, edge);
    const Face left = faces_[at(edge.left)], right = faces_[at(edge.right)];
    const auto sector = [](const Face& face, Index v) {
        return face.sectors[at(place_of(face, v))];
    };
    const auto line_after = [](const Face& face, Index v) {
        return face.lines[at(place_of(face, v))];
    };
    Face& first = faces_[at(edge.left)];
    Face& second = faces_[at(edge.right)];
    first.vertices = {c, d, edge.b};
    first.sectors = {sector(left, c), sector(right, d), sector(left, edge.b)};
    first.lines = {0, line_after(right, d), line_after(left, edge.b)};
    second.vertices = {d, c, edge.a};
    second.sectors = {sector(right, d), sector(left, c), sector(left, edge.a)};
    second.lines = {0, line_after(left, c), line_after(right, edge.a)};
    remove_from_fan(edge.a, edge.left);
    remove_from_fan(edge.b, edge.right);
    fans_[at(d)].push_back(edge.left);
    fans_[at(c)].push_back(edge.right);
}

TriangleEditor::Result TriangleEditor::result(const Mesh& source, const SurfaceSamples& samples,
                                              const Context& context) const {
    std::vector<Index> new_id(positions_.size(), kNoIndex);
    std::vector<Vec3> positions;
    Result result;
    std::vector<SurfaceSamples::Sample> of_vertex;
    for (Index v = 0; v < count_of(positions_); ++v) {
        context.checkpoint();
        const bool isolated = v < source.vertex_count() && source.topology().is_isolated(v);
        of_vertex.emplace_back();
        if (fan(v).empty() && !isolated) continue;
        new_id[at(v)] = count_of(positions);
        positions.push_back(position(v));
        if (!moved_[at(v)]) {
            result.map.vertices.add_blend(vertex_sources_[at(v)]);
            continue;
        }
        const Index origin = faces_[at(fan(v).front())].origin;
        of_vertex.back() = samples.nearest(origin, position(v));
        result.map.vertices.add_blend(of_vertex.back().vertices);
    }
    FaceList faces;
    for (const Face& face : faces_) {
        if (!face.alive()) continue;
        context.checkpoint();
        const Triangle& v = face.vertices;
        faces.add({new_id[at(v[0])], new_id[at(v[1])], new_id[at(v[2])]});
        result.map.faces.add_copy(face.origin);
        for (std::size_t k = 0; k < 3; ++k) {
            if (moved_[at(v[k])]) {
                result.map.corners.add_blend(of_vertex[at(v[k])].corners);
            } else {
                result.map.corners.add_blend(sector_sources_[at(face.sectors[k])]);
            }
        }
    }
    result.mesh = derive(source, std::move(positions), std::move(faces), result.map, context);
    return result;
}

}  // namespace lissom
