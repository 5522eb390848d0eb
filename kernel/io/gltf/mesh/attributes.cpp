#include "kernel/io/gltf/mesh/attributes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/core/geometry.h"
#include "kernel/io/stream/read_error.h"

namespace lissom {
namespace {

Index expected_width(GltfSemantic semantic) {
    switch (semantic) {
        case GltfSemantic::uv:
            return 2;
        case GltfSemantic::position:
        case GltfSemantic::normal:
            return 3;
        case GltfSemantic::tangent:
        case GltfSemantic::joints:
        case GltfSemantic::weights:
            return 4;
        default:
            return 0;
    }
}

// Returns the type of values in a mesh, in which fractions are numbers of their own.
ScalarType type_in_mesh(GltfSemantic semantic, const AccessorValues& read) {
    const bool keeps_integers = semantic == GltfSemantic::joints ||
                                (semantic == GltfSemantic::color && read.normalized) ||
                                (semantic == GltfSemantic::custom && !read.normalized);
    return keeps_integers ? read.type : ScalarType::float32;
}

// `wanted` 0 for any.
void require_width(const std::string& name, int accessor, Index width, Index wanted) {
    if (wanted == 0 || width == wanted) return;
    refuse(ErrorCode::file_syntax, "accessor " + std::to_string(accessor) + " of " + name +
                                       " has " + std::to_string(width) +
                                       " numbers an element instead of " + std::to_string(wanted));
}

void require_count(const VertexBlock& block, int accessor, const AccessorValues& read) {
    if (read.count == block.vertex_count) return;
    refuse(ErrorCode::file_syntax, "accessor " + std::to_string(accessor) + " has " +
                                       std::to_string(read.count) + " elements for " +
                                       std::to_string(block.vertex_count) + " positions");
}

// Vertices that only primitives without the attribute use have no value of it.
void erase_unused(const VertexBlock& block, const std::string& name, AccessorValues& read) {
    const auto has = [&](const tinygltf::Primitive* p) { return p->attributes.contains(name); };
    if (std::all_of(block.primitives.begin(), block.primitives.end(), has)) return;
    std::vector<char> used(block.vertex_count, 0);
    for (std::size_t p = 0; p < block.primitives.size(); ++p) {
        if (!has(block.primitives[p])) continue;
        for (const Index v : block.corners[p]) used[v] = 1;
    }
    const std::size_t width = read.width;
    for (std::size_t v = 0; v < used.size(); ++v) {
        if (!used[v]) std::fill_n(read.values.data() + v * width, width, kNone);
    }
}

// Puts four joints or weights beside those of the sets before.
void add_joint_set(const GltfAttributeName& name, const AccessorValues& read, AccessorValues& all) {
    const Index width = std::max<Index>(all.width, 4 * (name.set + 1));
    const bool is_first = all.values.empty();
    if (is_first) all.values.assign(read.count * width, 0.0);
    if (!is_first && width > all.width) all.values = widened(all.values, all.width, width, 0.0);
    all.count = read.count;
    all.width = width;
    all.type = type_in_mesh(name.semantic, read);
    for (std::size_t v = 0; v < read.count; ++v) {
        double* const to = all.values.data() + v * width;
        std::copy_n(read.values.data() + 4 * v, 4, to + 4 * name.set);
    }
}

}  // namespace

void VertexReader::add_positions(VertexBlock& block, const NodeTransform& transform) {
    const int accessor = block.attributes.at("POSITION");
    const PackedNumbers read = accessors_.packed(accessor);
    require_width("POSITION", accessor, read.width, 3);
    block.vertex_count = read.count;
    first_ = positions_.size();
    constexpr std::size_t kMaximum = std::numeric_limits<Index>::max();
    if (read.count > kMaximum - positions_.size()) {
        refuse(ErrorCode::file_too_large,
               "the file has more than " + std::to_string(kMaximum) + " vertices; split it");
    }
    positions_.resize(first_ + read.count);
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    if (read.count > 0) unpack(read, positions_[first_].data());
    for (std::size_t i = first_; i < positions_.size(); ++i) {
        positions_[i] = transform.position(Vec3(positions_[i]));
    }
}

// `width` 0 for any.
AccessorValues VertexReader::read_values(const std::string& name, int accessor, Index width) const {
    AccessorValues read = accessors_.values(accessor);
    require_width(name, accessor, read.width, width);
    return read;
}

void VertexReader::add_attributes(const VertexBlock& block, const NodeTransform& transform) {
    std::map<std::string, AccessorValues> joints;
    for (const auto& [name, accessor] : block.attributes) {
        const GltfAttributeName parsed = parse_gltf_attribute(name);
        if (parsed.semantic == GltfSemantic::position) continue;
        if (parsed.semantic == GltfSemantic::unknown) {
            skipped_.add("attributes " + in_quotes(name));
            continue;
        }
        AccessorValues read = read_values(name, accessor, expected_width(parsed.semantic));
        require_count(block, accessor, read);
        clean(parsed, read, transform);
        erase_unused(block, name, read);
        if (parsed.semantic == GltfSemantic::joints || parsed.semantic == GltfSemantic::weights) {
            add_joint_set(parsed, read, joints[parsed.name]);
        } else {
            add_column(parsed.name, type_in_mesh(parsed.semantic, read), read);
        }
    }
    add_joints(joints);
    for (std::size_t t = 0; t < block.targets.size(); ++t) {
        add_target(block, index_of(t) + 1, transform);
    }
}

// Makes the values those of a mesh.
void VertexReader::clean(const GltfAttributeName& name, AccessorValues& read,
                         const NodeTransform& transform) {
    drop_not_finite(name.name, read);
    const bool is_color = name.semantic == GltfSemantic::color;
    if (is_color && read.width != 3 && read.width != 4) {
        refuse(ErrorCode::file_syntax,
               "a color has " + std::to_string(read.width) + " numbers instead of 3 or 4");
    }
    const std::size_t width = read.width;
    for (std::size_t i = 0; i < read.count; ++i) {
        const std::span<double> value(read.values.data() + i * width, width);
        if (name.semantic == GltfSemantic::uv) value[1] = 1.0 - value[1];
        if (name.semantic == GltfSemantic::normal) transform.turn_normal(value);
        if (name.semantic == GltfSemantic::tangent) transform.turn_tangent(value);
    }
}

// An element with a value that is none has none.
void VertexReader::drop_not_finite(const std::string& name, AccessorValues& read) {
    if (read.type != ScalarType::float32 && read.type != ScalarType::float64) return;
    const std::size_t width = read.width;
    std::size_t count = 0;
    for (std::size_t i = 0; i < read.count; ++i) {
        const std::span<double> value(read.values.data() + i * width, width);
        const bool good =
            std::all_of(value.begin(), value.end(), [](double x) { return std::isfinite(x); });
        if (good) continue;
        ++count;
        std::fill(value.begin(), value.end(), kNone);
    }
    if (count > 0) not_finite_[name] += count;
}

void VertexReader::add_column(const std::string& name, ScalarType type,
                              const AccessorValues& read) {
    constexpr std::size_t kNumbersPerElement = 16;
    columns_.add(name, read.width, type, first_, read.values);
    budget_.require(columns_.number_count(positions_.size()) / kNumbersPerElement);
}

void VertexReader::add_joints(std::map<std::string, AccessorValues>& sets) {
    Index width = 0;
    for (const auto& [name, read] : sets) width = std::max(width, read.width);
    for (auto& [name, read] : sets) {
        if (read.width < width) read.values = widened(read.values, read.width, width, 0.0);
        read.width = width;
        add_column(name, read.type, read);
    }
}

void VertexReader::add_target(const VertexBlock& block, Index target,
                              const NodeTransform& transform) {
    for (const auto& [name, accessor] : block.targets[target - 1]) {
        const GltfSemantic semantic = parse_gltf_attribute(name).semantic;
        const bool is_known = semantic == GltfSemantic::position ||
                              semantic == GltfSemantic::normal || semantic == GltfSemantic::tangent;
        if (!is_known) {
            skipped_.add("attributes " + in_quotes(name) + " of morph targets");
            continue;
        }
        AccessorValues read = read_values(name, accessor, 3);
        require_count(block, accessor, read);
        drop_not_finite(morph_name(target, semantic), read);
        for (std::size_t v = 0; v < read.count; ++v) {
            transform.turn_delta(semantic, {read.values.data() + 3 * v, 3});
        }
        add_column(morph_name(target, semantic), ScalarType::float32, read);
    }
}

void VertexReader::finish(AttributeSet& attributes, Report& report) {
    columns_.finish(attributes, positions_.size());
    for (const auto& [name, count] : not_finite_) {
        report.add(FindingKind::values_not_finite, count, "of " + in_quotes(name));
    }
}

}  // namespace lissom
