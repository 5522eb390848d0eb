#include "kernel/mesh/resample/attribute_quadrics.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace lissom {
namespace {

bool is_measured(const Attribute& attribute) {
    if (attribute.domain == Domain::face) return false;
    switch (role_of(attribute)) {
        case AttributeRole::texture_coordinates:
        case AttributeRole::color:
        case AttributeRole::weights:
        case AttributeRole::morph_position:
            return true;
        case AttributeRole::value:
            return attribute.type == ScalarType::float32 || attribute.type == ScalarType::float64;
        default:
            return false;
    }
}

Index measured_columns(const Mesh& mesh) {
    Index count = 0;
    for (const Attribute& attribute : mesh.attributes().all()) {
        if (is_measured(attribute)) count += attribute.width;
    }
    return count;
}

// One over the range of a column; zero if all values are the same.
double column_scale(const Attribute& attribute, Index k) {
    double low = kNone, high = kNone;
    for (Index i = 0; i < attribute.size(); ++i) {
        const double x = attribute.at(i)[at(k)];
        low = std::fmin(low, x);
        high = std::fmax(high, x);
    }
    return high > low ? 1.0 / (high - low) : 0.0;
}

// Gradient of the function with given values at the corners of a triangle.
std::optional<Vec3> gradient_of(const std::array<Vec3, 3>& p, const std::array<double, 3>& s) {
    const Vec3 e1 = p[1] - p[0], e2 = p[2] - p[0], n = e1.cross(e2);
    const double square = n.squaredNorm();
    if (!(square > 0.0)) return std::nullopt;
    return Vec3(((s[1] - s[0]) * e2.cross(n) + (s[2] - s[0]) * n.cross(e1)) / square);
}

}  // namespace

AttributeQuadrics::AttributeQuadrics(const Mesh& mesh, const TriangleEditor& editor, double unit,
                                     const Vec3& center)
    : center_(center) {
    if (unit == 0.0) return;
    columns_ = measured_columns(mesh);
    if (columns_ == 0) return;
    const std::size_t size = lissom::at(editor.sector_count()) * lissom::at(columns_);
    values_.assign(size, 0.0);
    linear_.assign(size, {});
    quadrics_.assign(lissom::at(editor.sector_count()), {});
    Index column = 0;
    for (const Attribute& attribute : mesh.attributes().all()) {
        if (!is_measured(attribute)) continue;
        for (Index k = 0; k < attribute.width; ++k, ++column) {
            read_column(editor, attribute, k, column, unit);
            add_triangles(editor, column);
        }
    }
}

void AttributeQuadrics::read_column(const TriangleEditor& editor, const Attribute& attribute,
                                    Index k, Index column, double unit) {
    const double scale = unit * column_scale(attribute, k);
    for (const TriangleEditor::Face& face : editor.faces()) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Index element = attribute.domain == Domain::vertex
                                      ? face.vertices[i]
                                      : editor.corner_of_sector(face.sectors[i]);
            const double value = attribute.at(element)[lissom::at(k)];
            values_[place(face.sectors[i], column)] = std::isnan(value) ? 0.0 : scale * value;
        }
    }
}

void AttributeQuadrics::add_triangles(const TriangleEditor& editor, Index column) {
    for (const TriangleEditor::Face& face : editor.faces()) {
        std::array<Vec3, 3> p;
        std::array<double, 3> s{};
        for (std::size_t i = 0; i < 3; ++i) {
            p[i] = editor.position(face.vertices[i]) - center_;
            s[i] = values_[place(face.sectors[i], column)];
        }
        const std::optional<Vec3> g = gradient_of(p, s);
        if (!g) continue;
        const double d = s[0] - g->dot(p[0]), w = (p[1] - p[0]).cross(p[2] - p[0]).norm() / 6.0;
        for (const Index sector : face.sectors) {
            Quadric& quadric = quadrics_[lissom::at(sector)];
            quadric.a += w * *g * g->transpose();
            quadric.b += w * d * *g;
            quadric.c += w * d * d;
            if (column == 0) quadric.weight += w;
            Linear& linear = linear_[place(sector, column)];
            linear.gradient += w * *g;
            linear.constant += w * d;
        }
    }
}

double AttributeQuadrics::best(Index sector, Index other, const Vec3& point) const {
    if (empty()) return 0.0;
    const Vec3 p = point - center_;
    const Quadric &q = quadrics_[lissom::at(sector)], &r = quadrics_[lissom::at(other)];
    const double weight = q.weight + r.weight;
    double error = q.at(p) + r.at(p);
    for (Index k = 0; k < columns_ && weight > 0.0; ++k) {
        const double sum = linear_[place(sector, k)].at(p) + linear_[place(other, k)].at(p);
        error -= sum * sum / weight;
    }
    return std::max(error, 0.0);
}

double AttributeQuadrics::kept(Index sector, Index other, const Vec3& point) const {
    if (empty()) return 0.0;
    const Vec3 p = point - center_;
    const Quadric &q = quadrics_[lissom::at(sector)], &r = quadrics_[lissom::at(other)];
    double error = q.at(p) + r.at(p);
    for (Index k = 0; k < columns_; ++k) {
        const double s = values_[place(sector, k)];
        const double sum = linear_[place(sector, k)].at(p) + linear_[place(other, k)].at(p);
        error += s * (s * (q.weight + r.weight) - 2.0 * sum);
    }
    return std::max(error, 0.0);
}

void AttributeQuadrics::merge(Index sector, Index other) {
    if (empty()) return;
    quadrics_[lissom::at(sector)] += quadrics_[lissom::at(other)];
    for (Index k = 0; k < columns_; ++k) {
        Linear& linear = linear_[place(sector, k)];
        linear.gradient += linear_[place(other, k)].gradient;
        linear.constant += linear_[place(other, k)].constant;
    }
}

void AttributeQuadrics::merge_at(Index sector, Index other, const Vec3& p) {
    merge(sector, other);
    if (empty()) return;
    const double weight = quadrics_[lissom::at(sector)].weight;
    for (Index k = 0; k < columns_ && weight > 0.0; ++k) {
        values_[place(sector, k)] = linear_[place(sector, k)].at(p - center_) / weight;
    }
}

}  // namespace lissom
