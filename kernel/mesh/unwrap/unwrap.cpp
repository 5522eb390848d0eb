#include "kernel/mesh/unwrap/unwrap.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/unwrap/chart_packing.h"
#include "kernel/mesh/unwrap/face_graph.h"
#include "kernel/mesh/unwrap/flat_chart.h"

namespace lissom {
namespace {

// Charts are joined along so much of the border of one of them, or if one is so small a part of
// all.
constexpr double kLongBorder = 0.2, kSmallChart = 0.01;
// Sharpness of edges that part charts from the beginning, for a crease of 1, and the least part of
// all between such edges. No edge is as sharp as the second.
constexpr double kCrease = 1.0 / 3.0, kNoCrease = 2.0, kSmallPart = 0.002;
// Stretch of charts that are joined across a crease, over that before.
constexpr double kSameStretch = 1.02;
// Diagonal of charts that are not joined to longer ones, over the root of the whole area.
constexpr double kLongChart = 1.3;
// Sizes of meshes whose areas and their squares are numbers.
constexpr double kSmallest = 1e-20, kLargest = 1e20;
// Of memory, for each corner: the graph of faces, charts and their coordinates.
constexpr std::size_t kChartBytes = 320;
// Faces of pairs that were not flat together, over those of the mesh, up to which pairs are tried.
constexpr double kVainFaces = 4.0;

void require_unwrap(const Mesh& mesh, const UnwrapOptions& options) {
    require(mesh.face_count() > 0, "the mesh has no faces to unwrap", ErrorCode::mesh_empty);
    const double size = bounds(mesh).diagonal();
    require(size == 0.0 || (size > kSmallest && size < kLargest),
            "the mesh is too small or too large to be laid out; scale it to about 1");
    require(options.stretch > 1.0 && std::isfinite(options.stretch),
            "the stretch of charts is a factor above 1");
    require(options.crease >= 0.0 && std::isfinite(options.crease),
            "the weight of creases is 0 or more");
    require(options.gap >= 0.0005 && options.gap <= 0.1,
            "the gap is a part of the side from 0.0005 to 0.1");
}

class ChartMaker {
  public:
    ChartMaker(const Mesh& mesh, const UnwrapOptions& options, const Context& context)
        : graph_(mesh, options.crease),
          options_(options),
          context_(context),
          chart_of_(at(mesh.face_count()), kNoIndex) {
        for (Index f = 0; f < mesh.face_count(); ++f) total_ += graph_.area(f);
    }

    std::vector<FlatChart> run() {
        Progress progress(context_, "unwrap");
        progress.step(0.6);
        cut_apart();
        progress.step(0.4);
        while (join_some()) context_.checkpoint();
        std::vector<FlatChart> made;
        for (std::optional<FlatChart>& chart : charts_) {
            if (chart) made.push_back(std::move(*chart));
        }
        std::stable_sort(made.begin(), made.end(), [](const FlatChart& a, const FlatChart& b) {
            return a.area() > b.area();
        });
        return made;
    }

    const FaceGraph& graph() const { return graph_; }

  private:
    // Halves parts until each is flat.
    void cut_apart() {
        const double sharpness = options_.crease > 0.0 ? kCrease / options_.crease : kNoCrease;
        std::vector<std::vector<Index>> parts =
            parts_between_creases(graph_, sharpness, kSmallPart);
        while (!parts.empty()) {
            context_.checkpoint();
            const std::vector<Index> part = std::move(parts.back());
            parts.pop_back();
            std::optional<FlatChart> chart = flatten(graph_, part, options_.stretch, context_);
            if (chart) {
                add(std::move(*chart));
                continue;
            }
            for (std::vector<Index>& half : halves(graph_, part, context_)) {
                parts.push_back(std::move(half));
            }
        }
    }

    void add(FlatChart chart) {
        for (const Index f : chart.faces) chart_of_[at(f)] = count_of(charts_);
        charts_.push_back(std::move(chart));
    }

    struct Border {
        Index a = 0, b = 0;
        // The part of the border of the chart whose border is shorter, the lesser area, and the
        // mean sharpness of the edges.
        double part = 0.0, area = 0.0, sharpness = 0.0;
    };

    // Borders between charts, those of the smallest first, which need it most.
    std::vector<Border> borders() const {
        struct Length {
            double whole = 0.0, sharp = 0.0;
        };
        std::map<std::pair<Index, Index>, Length> shared;
        std::vector<double> outline(charts_.size(), 0.0);
        for (Index c = 0; c < graph_.mesh().topology().corner_count(); ++c) {
            const Index twin = graph_.twin(c), own = chart_of_[at(graph_.face_of(c))];
            const Index other = twin == kNoIndex ? kNoIndex : chart_of_[at(graph_.face_of(twin))];
            if (own == other) continue;
            const double length = graph_.edge_length(c);
            outline[at(own)] += length;
            if (other == kNoIndex || own > other) continue;
            Length& sum = shared[{own, other}];
            sum.whole += length;
            sum.sharp += length * graph_.sharpness(c);
        }
        std::vector<Border> list;
        for (const auto& [pair, length] : shared) {
            const double least = std::min(outline[at(pair.first)], outline[at(pair.second)]);
            const double area =
                std::min(charts_[at(pair.first)]->area(), charts_[at(pair.second)]->area());
            if (length.whole == 0.0) continue;
            list.push_back(
                {pair.first, pair.second, length.whole / least, area, length.sharp / length.whole});
        }
        std::stable_sort(list.begin(), list.end(),
                         [](const Border& x, const Border& y) { return x.area < y.area; });
        return list;
    }

    // Whether a chart would determine the side of the square.
    bool is_long(const FlatChart& chart) const {
        Vec2 low = chart.uv[0], high = low;
        for (const Vec2& p : chart.uv) {
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
        return (high - low).norm() > kLongChart * std::sqrt(total_);
    }

    // Across creases charts are joined if that stretches them no more than they are.
    double allowed(const Border& border) const {
        if (border.sharpness * options_.crease < kCrease) return options_.stretch;
        const double now =
            std::max(charts_[at(border.a)]->stretch(), charts_[at(border.b)]->stretch());
        return std::min(options_.stretch, kSameStretch * now);
    }

    // Joins pairs of charts that are flat together; each takes part once. Returns whether any did.
    bool join_some() {
        std::set<Index> changed;
        for (const Border& border : borders()) {
            if (changed.contains(border.a) || changed.contains(border.b)) continue;
            if (vain_ > kVainFaces * static_cast<double>(chart_of_.size())) break;
            const FlatChart &a = *charts_[at(border.a)], &b = *charts_[at(border.b)];
            const bool small = std::min(a.area(), b.area()) < kSmallChart * total_;
            if (border.part < kLongBorder && !small) continue;
            if (!tried_.insert({border.a, border.b}).second) continue;
            context_.checkpoint();
            std::vector<Index> faces;
            std::merge(a.faces.begin(), a.faces.end(), b.faces.begin(), b.faces.end(),
                       std::back_inserter(faces));
            std::optional<FlatChart> both = flatten(graph_, faces, allowed(border), context_);
            if (!both || is_long(*both)) {
                vain_ += static_cast<double>(faces.size());
                continue;
            }
            charts_[at(border.a)].reset();
            charts_[at(border.b)].reset();
            changed.insert({border.a, border.b});
            add(std::move(*both));
        }
        return !changed.empty();
    }

    FaceGraph graph_;
    const UnwrapOptions& options_;
    const Context& context_;
    std::vector<std::optional<FlatChart>> charts_;
    std::vector<Index> chart_of_;
    std::set<std::pair<Index, Index>> tried_;
    double total_ = 0.0, vain_ = 0.0;
};

void measure(const std::vector<FlatChart>& charts, Unwrapping& result) {
    std::vector<std::pair<double, double>> all;
    double area = 0.0, sum = 0.0;
    for (const FlatChart& chart : charts) {
        for (std::size_t t = 0; t < chart.areas.size(); ++t) {
            all.emplace_back(chart.stretches[t], chart.areas[t]);
            area += chart.areas[t];
            sum += chart.areas[t] * chart.stretches[t];
        }
        for (const Triangle& t : chart.triangles) {
            const Vec2 u = chart.uv[at(t[1])] - chart.uv[at(t[0])];
            const Vec2 v = chart.uv[at(t[2])] - chart.uv[at(t[0])];
            result.coverage += 0.5 * std::abs(u.x() * v.y() - u.y() * v.x());
        }
    }
    result.coverage /= result.side * result.side;
    result.mean_stretch = area > 0.0 ? sum / area : 1.0;
    std::sort(all.begin(), all.end(), std::greater<>());
    double above = 0.0;
    for (const auto& [stretch, part] : all) {
        result.stretch = stretch;
        above += part;
        if (above > 0.02 * area) break;
    }
}

// Faces that run clockwise in the square.
std::vector<Index> flipped_faces(const Topology& topology, const std::vector<Vec2>& uv) {
    std::vector<Index> faces;
    for (Index f = 0; f < topology.face_count(); ++f) {
        const std::size_t first = at(topology.first_corner(f)), count = topology.face(f).size();
        double doubled = 0.0;
        for (std::size_t k = 0; k < count; ++k) {
            const Vec2 a = uv[first + k] - uv[first], b = uv[first + (k + 1) % count] - uv[first];
            doubled += a.x() * b.y() - a.y() * b.x();
        }
        if (doubled < 0.0) faces.push_back(f);
    }
    return faces;
}

bool same_place(const Vec2& a, const Vec2& b) {
    return (a - b).squaredNorm() < 1e-18;
}

// Length of inner edges whose faces lie apart in the square.
double seams_of(const FaceGraph& graph, const std::vector<Vec2>& uv) {
    double length = 0.0;
    for (Index c = 0; c < count_of(uv); ++c) {
        const Index twin = graph.twin(c);
        if (twin == kNoIndex || twin < c) continue;
        const bool joined = same_place(uv[at(c)], uv[at(graph.next(twin))]) &&
                            same_place(uv[at(graph.next(c))], uv[at(twin)]);
        if (!joined) length += graph.edge_length(c);
    }
    return length;
}

}  // namespace

Unwrapping unwrap(const Mesh& mesh, const UnwrapOptions& options, const Context& context) {
    require_unwrap(mesh, options);
    const MemoryCharge charge =
        context.charge(kChartBytes * at(mesh.topology().corner_count()), "the charts of a mesh");
    ChartMaker maker(mesh, options, context);
    std::vector<FlatChart> charts = maker.run();
    Unwrapping result;
    result.side = pack_charts(charts, options.gap, context);
    result.chart_count = count_of(charts);
    result.uv.resize(at(mesh.topology().corner_count()));
    result.chart.resize(at(mesh.face_count()));
    for (std::size_t i = 0; i < charts.size(); ++i) {
        std::size_t corner = 0;
        for (const Index f : charts[i].faces) {
            result.chart[at(f)] = index_of(i);
            for (std::size_t k = 0; k < mesh.topology().face(f).size(); ++k) {
                const Vec2& place = charts[i].uv[at(charts[i].places[corner++])];
                result.uv[at(mesh.topology().first_corner(f)) + k] =
                    (place / result.side).cwiseMax(0.0).cwiseMin(1.0);
            }
        }
    }
    measure(charts, result);
    result.flipped = flipped_faces(mesh.topology(), result.uv);
    result.seam_length = seams_of(maker.graph(), result.uv);
    return result;
}

void write_unwrapping(Mesh& mesh, const Unwrapping& unwrapping, std::string_view name) {
    require(!name.empty(), "texture coordinates need a name");
    require(count_of(unwrapping.uv) == mesh.topology().corner_count(),
            "the unwrapping is of another mesh; unwrap this one", ErrorCode::topology_mismatch);
    const Attribute* before = mesh.attributes().find(name);
    Attribute uv{std::string(name),
                 Domain::corner,
                 2,
                 before && before->width == 2 ? before->type : ScalarType::float32,
                 {}};
    for (const Vec2& p : unwrapping.uv) {
        uv.values.push_back(p.x());
        uv.values.push_back(p.y());
    }
    if (before) mesh.attributes().remove(name);
    mesh.attributes().add(std::move(uv));
}

}  // namespace lissom
