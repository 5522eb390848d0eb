#include "kernel/io/vertex_texture.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/io/mesh_file.h"
#include "kernel/io/png16.h"
#include "kernel/io/stream/file.h"
#include "kernel/mesh/measure/measures.h"

namespace lissom {
namespace {

constexpr Index kMaxWidth = 4096, kMaxHeight = 16384;
constexpr double kSteps = 65535.0;

// Rows of vertices of one frame.
Index texel_blocks_of(Index vertex_count) {
    return (vertex_count + kMaxWidth - 1) / kMaxWidth;
}

std::size_t texel_of(Index width, Index frames, Index vertex, Index frame) {
    const Index row = vertex / width * frames + frame;
    return at(row) * at(width) + at(vertex % width);
}

Vec3 decoded(const std::vector<std::uint16_t>& rgb, std::size_t texel, const Box& bounds) {
    Vec3 value;
    for (int k = 0; k < 3; ++k) {
        const double share = rgb[3 * texel + static_cast<std::size_t>(k)] / kSteps;
        value[k] = bounds.min[k] + share * (bounds.max[k] - bounds.min[k]);
    }
    return value;
}

void encode(const Vec3& value, const Box& bounds, std::size_t texel,
            std::vector<std::uint16_t>& rgb) {
    for (int k = 0; k < 3; ++k) {
        const double extent = bounds.max[k] - bounds.min[k];
        const double share = extent > 0.0 ? (value[k] - bounds.min[k]) / extent : 0.0;
        rgb[3 * texel + static_cast<std::size_t>(k)] =
            static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.0, 1.0) * kSteps));
    }
}

Box unit_box() {
    return {Vec3::Constant(-1.0), Vec3::Constant(1.0)};
}

// The first set of texture coordinates that the mesh does not have, the second at least: the first
// is that of its pictures.
std::string free_coordinates(const Mesh& mesh) {
    Index set = 2;
    while (mesh.attributes().find("uv" + std::to_string(set))) ++set;
    return "uv" + std::to_string(set);
}

// The middle of each vertex's texel in the first frame; v counts from the bottom, as all texture
// coordinates of a mesh do.
Attribute coordinates_of(const VertexTexture& texture) {
    Attribute uv{texture.coordinates, Domain::vertex, 2, ScalarType::float32, {}};
    const auto frames = count_of(texture.times);
    for (Index v = 0; v < texture.mesh.vertex_count(); ++v) {
        const Index column = v % texture.width, row = v / texture.width * frames;
        uv.values.push_back((column + 0.5) / texture.width);
        uv.values.push_back(1.0 - (row + 0.5) / texture.height);
    }
    return uv;
}

nlohmann::json numbers(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

std::string name_of(const std::filesystem::path& path) {
    const std::u8string name = path.filename().u8string();
    return {name.begin(), name.end()};
}

// "uv2" is TEXCOORD_1.
std::string gltf_name_of(const std::string& coordinates) {
    return "TEXCOORD_" + std::to_string(std::stoi(coordinates.substr(2)) - 1);
}

std::string description_of(const VertexTexture& texture, const VertexTextureFiles& files) {
    nlohmann::json json;
    json["format"] = "lissom vertex texture";
    json["version"] = 1;
    json["mesh"] = name_of(files.mesh);
    json["coordinates"] = gltf_name_of(texture.coordinates);
    json["vertices"] = texture.mesh.vertex_count();
    json["frames"] = texture.times.size();
    json["times"] = texture.times;
    json["width"] = texture.width;
    json["height"] = texture.height;
    json["frame_step"] = 1.0 / texture.height;
    json["positions"] = {{"file", name_of(files.positions)},
                         {"min", numbers(texture.bounds.min)},
                         {"max", numbers(texture.bounds.max)},
                         {"max_error", texture.max_error}};
    json["normals"] = {{"file", name_of(files.normals)},
                       {"min", numbers(unit_box().min)},
                       {"max", numbers(unit_box().max)},
                       {"max_error", texture.max_normal_error}};
    return json.dump(2) + '\n';
}

std::vector<Vec3> normals_of_vertices(const Mesh& shape) {
    const Attribute* own = shape.attributes().find("normal");
    if (!own || own->domain != Domain::vertex || own->width != 3) return vertex_normals(shape);
    std::vector<Vec3> normals = vertex_normals(shape);
    for (Index v = 0; v < shape.vertex_count(); ++v) {
        const auto value = own->at(v);
        const Vec3 given(value[0], value[1], value[2]);
        if (given.allFinite() && given.norm() > 0.0) normals[at(v)] = given.normalized();
    }
    return normals;
}

}  // namespace

Vec3 VertexTexture::position(Index vertex, Index frame) const {
    return decoded(positions, texel_of(width, count_of(times), vertex, frame), bounds);
}

Vec3 VertexTexture::normal(Index vertex, Index frame) const {
    return decoded(normals, texel_of(width, count_of(times), vertex, frame), unit_box());
}

VertexTextureBaker::VertexTextureBaker(const Mesh& rest, Context context)
    : rest_(rest), context_(std::move(context)) {
    if (rest.face_count() == 0) {
        throw Error(ErrorCode::unsupported, "a mesh without faces cannot be baked");
    }
}

void VertexTextureBaker::add(double time, const Mesh& shape) {
    context_.checkpoint();
    require_same_topology(shape, rest_.shared_topology(), "the baker");
    if (!std::isfinite(time) || (!times_.empty() && !(time > times_.back()))) {
        throw Error(ErrorCode::invalid_argument, "times must be finite and ascending");
    }
    if (count_of(times_) >= kMaxHeight / texel_blocks_of(rest_.vertex_count())) {
        throw Error(ErrorCode::invalid_argument,
                    "a texture of 16384 rows has no room for more than " +
                        std::to_string(times_.size()) + " frames of so many vertices");
    }
    charges_.push_back(context_.charge(2 * shape.positions().size() * sizeof(Vec3), "a frame"));
    positions_.emplace_back(shape.positions().begin(), shape.positions().end());
    normals_.push_back(normals_of_vertices(shape));
    times_.push_back(time);
}

VertexTexture VertexTextureBaker::finish() const {
    if (times_.empty()) {
        throw Error(ErrorCode::invalid_argument, "there is no shape to bake; add one");
    }
    const Index vertices = rest_.vertex_count(), frames = count_of(times_);
    VertexTexture texture{rest_, free_coordinates(rest_), times_, 0, 0, {}, {}, {}, 0.0, 0.0};
    texture.width = std::min(vertices, kMaxWidth);
    texture.height = texel_blocks_of(vertices) * frames;
    const std::size_t size = 3 * at(texture.width) * at(texture.height);
    texture.positions.assign(size, 0);
    texture.normals.assign(size, 0);
    for (const std::vector<Vec3>& frame : positions_) {
        for (const Vec3& p : frame) texture.bounds.extend(p);
    }
    for (Index f = 0; f < frames; ++f) {
        context_.checkpoint();
        for (Index v = 0; v < vertices; ++v) {
            const Vec3 &p = positions_[at(f)][at(v)], &n = normals_[at(f)][at(v)];
            const std::size_t texel = texel_of(texture.width, frames, v, f);
            encode(p, texture.bounds, texel, texture.positions);
            encode(n, unit_box(), texel, texture.normals);
            texture.max_error = std::max(texture.max_error, (texture.position(v, f) - p).norm());
            texture.max_normal_error =
                std::max(texture.max_normal_error, (texture.normal(v, f) - n).norm());
        }
    }
    texture.mesh.attributes().add(coordinates_of(texture));
    return texture;
}

void save_vertex_texture(const VertexTexture& texture, const VertexTextureFiles& files,
                         const Context& context) {
    const std::string positions = encode_png16(texture.width, texture.height, texture.positions);
    const std::string normals = encode_png16(texture.width, texture.height, texture.normals);
    SaveOptions options;
    options.normals = true;
    save_mesh(texture.mesh, files.mesh, options, context);
    write_file_atomically(files.positions, positions, context);
    write_file_atomically(files.normals, normals, context);
    write_file_atomically(files.description, description_of(texture, files), context);
}

}  // namespace lissom
