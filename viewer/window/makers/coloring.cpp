#include "viewer/window/makers/coloring.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "kernel/mesh/measure/distortion.h"
#include "viewer/render/draw/region_colors.h"

namespace lissom::window {
namespace {

using By = Coloring::By;

bool has_regions(const Picture& picture) {
    return std::any_of(picture.meshes.begin(), picture.meshes.end(),
                       [](const DrawnMesh& drawn) { return !regions_of(drawn).empty(); });
}

// Names of the attributes that can be drawn.
std::set<std::string> value_names(const Picture& picture) {
    std::set<std::string> names;
    for (const DrawnMesh& drawn : picture.meshes) {
        for (const Attribute& attribute : drawn.mesh->attributes().all()) {
            const bool drawable = attribute.domain == Domain::vertex && attribute.width == 1;
            if (drawable) names.insert(attribute.name);
        }
    }
    return names;
}

void clear(MeshStyle& style) {
    style.values.clear();
    style.region.reset();
    style.handles.clear();
    style.parts.clear();
}

void color_values(Picture& picture, const std::string& name) {
    for (DrawnMesh& drawn : picture.meshes) {
        const Attribute* attribute = drawn.mesh->attributes().find(name);
        if (!attribute || attribute->domain != Domain::vertex || attribute->width != 1) continue;
        drawn.style.values = attribute->values;
    }
}

std::vector<double> degrees(std::vector<double> angles) {
    for (double& angle : angles) angle /= kDegree;
    return angles;
}

// Returns the scale of a distortion: between its first and 99th percentile, and wide enough that
// changes by rounding are of one colour.
ValueRange distortion_range(const std::vector<DrawnMesh>& meshes, By by) {
    std::vector<double> values;
    for (const DrawnMesh& drawn : meshes) {
        std::copy_if(drawn.style.values.begin(), drawn.style.values.end(),
                     std::back_inserter(values), [](double value) { return std::isfinite(value); });
    }
    const ValueRange least = by == By::angle ? ValueRange{0.0, 1.0} : ValueRange{0.99, 1.01};
    if (values.empty()) return least;
    const auto quantile = [&](double part) {
        const auto at = values.begin() +
                        static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
        std::nth_element(values.begin(), at, values.end());
        return *at;
    };
    return {std::min(least.low, quantile(0.01)), std::max(least.high, quantile(0.99))};
}

void color_distortion(Picture& picture, By by, const std::vector<RestShapes::MeshPtr>& rest,
                      const Context& context) {
    for (std::size_t i = 0; i < picture.meshes.size(); ++i) {
        DrawnMesh& drawn = picture.meshes[i];
        Distortion found = distortion(*drawn.mesh, *rest[i], context);
        drawn.style.values = by == By::stretch ? std::move(found.stretch)
                             : by == By::area  ? std::move(found.area)
                                               : degrees(std::move(found.angle));
    }
    picture.range = distortion_range(picture.meshes, by);
}

// Surfaces keep their colours, which arrows stand out from.
Picture with_field(Picture picture) {
    const std::vector<DrawnLine>& lines = picture.field_marks.lines;
    picture.marks.lines.insert(picture.marks.lines.end(), lines.begin(), lines.end());
    picture.legend = true;
    picture.legend_parts = picture.field_marks.names;
    picture.legend_label = "field";
    return picture;
}

bool same_faces(const Mesh& a, const Mesh& b) {
    if (a.shared_topology() == b.shared_topology()) return true;
    const FaceList &f = a.topology().faces(), &g = b.topology().faces();
    return a.vertex_count() == b.vertex_count() && f.offsets == g.offsets &&
           f.vertices == g.vertices;
}

}  // namespace

bool is_distortion(const Coloring& coloring) {
    return coloring.by == By::stretch || coloring.by == By::area || coloring.by == By::angle;
}

std::string label_of(const Coloring& coloring) {
    switch (coloring.by) {
        case By::regions:
            return "regions";
        case By::field:
            return "field and constraints";
        case By::values:
            return coloring.attribute;
        case By::stretch:
            return "stretch of edges";
        case By::area:
            return "change of areas";
        case By::angle:
            return "change of angles";
        default:
            return "own";
    }
}

std::vector<Coloring> colorings_of(const Picture& picture) {
    std::vector<Coloring> result{{By::own}};
    if (!picture.field_marks.lines.empty()) result.push_back({By::field});
    if (picture.meshes.empty()) return result;
    if (has_regions(picture)) result.push_back({By::regions});
    for (const std::string& name : value_names(picture)) result.push_back({By::values, name});
    for (const By by : {By::stretch, By::area, By::angle}) result.push_back({by});
    return result;
}

void RestShapes::see(const Picture& picture) {
    shapes_.resize(picture.meshes.size());
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
        const MeshPtr& mesh = picture.meshes[i].mesh;
        if (!shapes_[i] || !same_faces(*shapes_[i], *mesh)) shapes_[i] = mesh;
    }
}

Picture colored(Picture picture, const Coloring& coloring,
                const std::vector<RestShapes::MeshPtr>& rest, const Context& context) {
    if (coloring.by == By::own) return picture;
    if (coloring.by == By::field) return with_field(std::move(picture));
    for (DrawnMesh& drawn : picture.meshes) clear(drawn.style);
    picture.range.reset();
    picture.legend = true;
    picture.legend_parts.clear();
    picture.legend_label = label_of(coloring);
    if (coloring.by == By::angle) picture.legend_label += " (degrees)";
    if (coloring.by == By::regions) picture.legend_parts = color_regions(picture.meshes);
    if (coloring.by == By::values) color_values(picture, coloring.attribute);
    if (is_distortion(coloring)) color_distortion(picture, coloring.by, rest, context);
    return picture;
}

}  // namespace lissom::window
