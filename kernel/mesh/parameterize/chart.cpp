#include "kernel/mesh/parameterize/chart.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <unordered_set>
#include <utility>

#include "kernel/mesh/fill/minimum_area.h"
#include "kernel/mesh/parameterize/chart_check.h"

namespace lissom {
namespace {

// Numbers the vertices that triangles use, in ascending order.
class VertexNumbers {
  public:
    explicit VertexNumbers(Index vertex_count) : number_(at(vertex_count), kNoIndex) {}

    std::vector<Index> take(std::span<const Triangle> triangles) {
        std::vector<Index> used;
        for (const Triangle& t : triangles) {
            for (const Index v : t) {
                if (std::exchange(number_[v], 0) == kNoIndex) used.push_back(v);
            }
        }
        std::sort(used.begin(), used.end());
        for (Index i = 0; i < count_of(used); ++i) number_[used[i]] = i;
        return used;
    }
    Triangle operator()(const Triangle& t) const {
        return {number_[t[0]], number_[t[1]], number_[t[2]]};
    }
    bool has(const Triangle& t) const {
        return std::all_of(t.begin(), t.end(), [&](Index v) { return number_[v] != kNoIndex; });
    }

  private:
    std::vector<Index> number_;
};

std::vector<Vec3> positions_about_mean(const Mesh& mesh, std::span<const Index> vertices) {
    Vec3 mean = Vec3::Zero();
    for (const Index v : vertices) mean += mesh.position(v) / static_cast<double>(vertices.size());
    std::vector<Vec3> result;
    result.reserve(vertices.size());
    for (const Index v : vertices) result.emplace_back(mesh.position(v) - mean);
    return result;
}

// The longest loop comes first; the others stay in their order.
void put_longest_first(const Chart& chart, std::vector<std::vector<Index>>& loops) {
    const auto shorter = [&](const auto& a, const auto& b) {
        return loop_length(chart, a) < loop_length(chart, b);
    };
    const auto longest = std::max_element(loops.begin(), loops.end(), shorter);
    std::rotate(loops.begin(), longest, std::next(longest));
}

void add_fill(Chart& chart, const Mesh& mesh, const VertexNumbers& numbers,
              std::span<const Triangle> fill) {
    for (const Triangle& t : fill) {
        require_vertices(mesh.topology(), t);
        if (!numbers.has(t)) {
            throw Error(ErrorCode::invalid_argument,
                        "a triangle to close a hole has a vertex that none of the faces has; use "
                        "vertices of their boundary");
        }
        chart.triangles.push_back(numbers(t));
    }
}

// Edges of triangles that join two vertices of one loop, by pair_key of their places in it.
std::unordered_set<std::uint64_t> edges_within(std::span<const Triangle> triangles,
                                               std::span<const Index> place) {
    std::unordered_set<std::uint64_t> edges;
    for (const Triangle& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            const Index a = place[at(t[k])], b = place[at(t[(k + 1) % 3])];
            if (a != kNoIndex && b != kNoIndex) {
                edges.insert(pair_key(std::min(a, b), std::max(a, b)));
            }
        }
    }
    return edges;
}

// Triangles over a loop, against its direction.
void close_loop(Chart& chart, std::span<const Index> loop, const Context& context) {
    const std::vector<Index> outline(loop.rbegin(), loop.rend());
    std::vector<Index> place(chart.positions.size(), kNoIndex);
    std::vector<Vec3> points;
    for (Index i = 0; i < count_of(outline); ++i) {
        place[outline[i]] = i;
        points.push_back(chart.positions[outline[i]]);
    }
    const auto edges = edges_within(chart.triangles, place);
    const auto taken = [&](Index i, Index k) { return edges.contains(pair_key(i, k)); };
    const std::vector<Triangle> triangles = minimum_area_triangles(points, taken, context);
    if (triangles.empty()) {
        Elements elements{ElementKind::vertex, 0, {}};
        elements.add(chart.vertex[loop[0]]);
        throw Error(ErrorCode::not_a_disk,
                    "no triangles close the hole at " + describe(elements) +
                        ", since faces have the edges that they would need; give triangles of "
                        "your own, or clear close_holes",
                    elements);
    }
    for (const auto& [a, b, c] : triangles) {
        chart.triangles.push_back({outline[a], outline[b], outline[c]});
    }
}

void find_open_loops(Chart& chart) {
    chart.open_loops = chart.triangles.size() == chart.face.size()
                           ? chart.loops
                           : boundaries_of_chart(chart.triangles, chart.vertex);
    put_longest_first(chart, chart.open_loops);
}

}  // namespace

double loop_length(const Chart& chart, std::span<const Index> loop) {
    double length = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Index next = loop[(i + 1) % loop.size()];
        length += (chart.positions[next] - chart.positions[loop[i]]).norm();
    }
    return length;
}

Chart make_chart(const Mesh& mesh, std::span<const Index> faces, std::span<const Triangle> fill,
                 bool close_holes, const Context& context) {
    require_faces(mesh.topology(), faces);
    std::vector<Index> ascending(faces.begin(), faces.end());
    std::sort(ascending.begin(), ascending.end());
    ascending.erase(std::unique(ascending.begin(), ascending.end()), ascending.end());
    require(!ascending.empty(), "there are no faces to lay out; choose a region that has some",
            ErrorCode::region_empty);
    Triangulation surface = triangulate_faces(mesh.topology(), mesh.positions(), ascending);
    context.checkpoint();
    VertexNumbers numbers(mesh.vertex_count());
    Chart chart;
    chart.vertex = numbers.take(surface.triangles);
    chart.positions = positions_about_mean(mesh, chart.vertex);
    chart.face = std::move(surface.face);
    for (const Triangle& t : surface.triangles) chart.triangles.push_back(numbers(t));
    chart.loops = boundaries_of_chart(chart.triangles, chart.vertex);
    put_longest_first(chart, chart.loops);
    context.checkpoint();
    add_fill(chart, mesh, numbers, fill);
    find_open_loops(chart);
    if (!close_holes || chart.open_loops.size() == 1) return chart;
    for (std::size_t i = 1; i < chart.open_loops.size(); ++i) {
        close_loop(chart, chart.open_loops[i], context);
    }
    chart.open_loops.resize(1);
    return chart;
}

}  // namespace lissom
