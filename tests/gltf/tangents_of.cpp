// Writes the corners of a model and their tangents for a comparison with other programs:
//     tangents_of MODEL OUTPUT
// OUTPUT has 12 floats a corner of a triangle: position, unit normal, texture coordinates, tangent
// and sign.
#include <cstdio>
#include <exception>
#include <fstream>
#include <vector>

#include "kernel/io/mesh_file.h"
#include "kernel/mesh/render/render_map.h"

using namespace lissom;

namespace {

std::vector<float> corners_of(const Mesh& mesh) {
    const RenderMap map = render_map(mesh);
    const std::vector<Vec3> normals = render_normals(map, mesh);
    const std::vector<Tangent> tangents = render_tangents(map, mesh, "uv");
    const Attribute& uvs = *mesh.attributes().find("uv");
    std::vector<float> numbers;
    const auto add = [&](std::span<const double> values) {
        for (const double x : values) numbers.push_back(static_cast<float>(x));
    };
    for (const Triangle& triangle : render_triangles(map, mesh)) {
        for (const Index r : triangle) {
            const Index v = map.vertex[at(r)];
            const Tangent& tangent = tangents[at(r)];
            add({mesh.position(v).data(), 3});
            add({normals[at(r)].data(), 3});
            add(uvs.at(uvs.domain == Domain::vertex ? v : map.corner[at(r)]).first(2));
            add({tangent.direction.data(), 3});
            add({&tangent.sign, 1});
        }
    }
    return numbers;
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 3) return 2;
    try {
        const std::vector<float> numbers = corners_of(load_mesh(arguments[1]));
        std::ofstream file(arguments[2], std::ios::binary);
        file.write(reinterpret_cast<const char*>(numbers.data()),
                   static_cast<std::streamsize>(numbers.size() * sizeof(float)));
        return file ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", arguments[1], error.what());
        return 1;
    }
}
