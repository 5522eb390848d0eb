#include "tests/bench/peers/io_rivals.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <tiny_gltf.h>

namespace lissom::bench {
namespace {

using RivalMesh = OpenMesh::TriMesh_ArrayKernelT<>;

const unsigned char* bytes_of(const tinygltf::Model& model, const tinygltf::Accessor& accessor) {
    const tinygltf::BufferView& view = model.bufferViews[accessor.bufferView];
    return model.buffers[view.buffer].data.data() + view.byteOffset + accessor.byteOffset;
}

bool parse(const std::filesystem::path& path, tinygltf::Model& model) {
    tinygltf::TinyGLTF loader;
    std::string error, warning;
    return loader.LoadBinaryFromFile(&model, &error, &warning, path.string());
}

const tinygltf::Accessor& indices_of(const tinygltf::Model& model) {
    return model.accessors[model.meshes[0].primitives[0].indices];
}

// A mesh of the one primitive that the file has, with tightly packed floats and 32-bit indices.
RivalMesh half_edge_mesh(const tinygltf::Model& model) {
    const tinygltf::Primitive& primitive = model.meshes[0].primitives[0];
    const tinygltf::Accessor& points = model.accessors[primitive.attributes.at("POSITION")];
    const tinygltf::Accessor& indices = indices_of(model);
    RivalMesh mesh;
    mesh.reserve(points.count, points.count + indices.count / 3, indices.count / 3);
    const unsigned char* at = bytes_of(model, points);
    for (std::size_t v = 0; v < points.count; ++v, at += 3 * sizeof(float)) {
        float xyz[3];
        std::memcpy(xyz, at, sizeof(xyz));
        mesh.add_vertex({xyz[0], xyz[1], xyz[2]});
    }
    at = bytes_of(model, indices);
    for (std::size_t t = 0; t < indices.count / 3; ++t, at += 3 * sizeof(std::uint32_t)) {
        std::uint32_t corners[3];
        std::memcpy(corners, at, sizeof(corners));
        const auto vertex = [&](int k) { return mesh.vertex_handle(corners[k]); };
        mesh.add_face(vertex(0), vertex(1), vertex(2));
    }
    return mesh;
}

}  // namespace

std::size_t read_with_openmesh(const std::filesystem::path& path) {
    RivalMesh mesh;
    return OpenMesh::IO::read_mesh(mesh, path.string()) ? mesh.n_faces() : 0;
}

std::size_t read_with_tinygltf(const std::filesystem::path& path) {
    tinygltf::Model model;
    return parse(path, model) ? indices_of(model).count / 3 : 0;
}

std::size_t read_with_tinygltf_into_openmesh(const std::filesystem::path& path) {
    tinygltf::Model model;
    return parse(path, model) ? half_edge_mesh(model).n_faces() : 0;
}

}  // namespace lissom::bench
