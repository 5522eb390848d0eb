// Vertex animation textures: what a shader reads from the pictures are the shapes. Without
// stb_image nothing can read them.
#if __has_include(<stb/stb_image.h>)
#include "kernel/io/vertex_texture.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "kernel/core/error.h"
#include "kernel/io/mesh_file.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/io/io_support.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#include <stb/stb_image.h>

using namespace lissom;
using namespace lissom::test;

namespace {

struct Picture {
    explicit Picture(const std::filesystem::path& path) {
        int channels = 0;
        stbi_us* const read = stbi_load_16(path.c_str(), &width, &height, &channels, 3);
        REQUIRE(read);
        CHECK(channels == 3);
        CHECK(stbi_is_16_bit(path.c_str()));
        pixels.assign(read, read + 3 * static_cast<std::size_t>(width * height));
        stbi_image_free(read);
    }

    // The value at texture coordinates, v from the top, between the corners of a range.
    Vec3 at(double u, double v, const nlohmann::json& range) const {
        const auto column = static_cast<int>(u * width), row = static_cast<int>(v * height);
        Vec3 value;
        for (int k = 0; k < 3; ++k) {
            const double least = range["min"][static_cast<std::size_t>(k)];
            const double greatest = range["max"][static_cast<std::size_t>(k)];
            const std::size_t place = 3 * static_cast<std::size_t>(row * width + column);
            value[k] =
                least + pixels[place + static_cast<std::size_t>(k)] / 65535.0 * (greatest - least);
        }
        return value;
    }

    int width = 0, height = 0;
    std::vector<std::uint16_t> pixels;
};

Mesh bent(const Mesh& mesh, double amount) {
    Mesh shape = mesh;
    for (Vec3& p : shape.edit_positions()) p.x() += amount * p.y() * p.y();
    return shape;
}

std::string content_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

}  // namespace

TEST_CASE(
    "what a shader reads from the pictures of a texture are the shapes, within the told error") {
    // More vertices than a row has columns, and fewer.
    for (const Index vertices : {9000, 2000}) {
        CAPTURE(vertices);
        const Mesh rest = make_cactus({.vertices = vertices});
        VertexTextureBaker baker(rest);
        std::vector<Mesh> shapes;
        for (int f = 0; f < 5; ++f) {
            shapes.push_back(bent(rest, 0.1 * f));
            baker.add(0.25 * f, shapes.back());
        }
        const VertexTexture texture = baker.finish();
        const TemporaryFolder folder;
        const VertexTextureFiles files{folder / "a.glb", folder / "a.json", folder / "p.png",
                                       folder / "n.png"};
        save_vertex_texture(texture, files);

        const nlohmann::json json = nlohmann::json::parse(content_of(files.description));
        CHECK(json["positions"]["file"] == "p.png");
        CHECK(json["coordinates"] == "TEXCOORD_1");
        const Picture positions(files.positions), normals(files.normals);
        CHECK(positions.width == json["width"]);
        CHECK(positions.height == json["height"]);
        const Mesh mesh = load_mesh(files.mesh);
        REQUIRE(mesh.vertex_count() == rest.vertex_count());
        const Attribute* uv = mesh.attributes().find("uv2");
        REQUIRE(uv);
        const double step = json["frame_step"];
        double worst = 0.0, turned = 0.0;
        for (Index f = 0; f < 5; ++f) {
            const std::vector<Vec3> wanted = vertex_normals(shapes[at(f)]);
            for (Index v = 0; v < rest.vertex_count(); ++v) {
                const double across = uv->at(v)[0], down = 1.0 - uv->at(v)[1] + f * step;
                const Vec3 p = positions.at(across, down, json["positions"]);
                const Vec3 n = normals.at(across, down, json["normals"]);
                worst = std::max(worst, (p - shapes[at(f)].position(v)).norm());
                turned = std::max(turned, (n - wanted[at(v)]).norm());
            }
        }
        CHECK(worst <= texture.max_error + 1e-12);
        CHECK(worst > 0.5 * texture.max_error);
        CHECK(texture.max_error <= 0.501 * texture.bounds.diagonal() / 65535.0);
        CHECK(turned <= texture.max_normal_error + 1e-12);
        CHECK(turned < 1e-4);
        CHECK(static_cast<double>(json["positions"]["max_error"]) == texture.max_error);
    }
}

TEST_CASE("textures refuse times that do not ascend, too many frames and other meshes") {
    const Mesh rest = make_bar({.across = 2, .along = 6});
    VertexTextureBaker baker(rest);
    CHECK_THROWS_AS(static_cast<void>(baker.finish()), Error);
    baker.add(0.0, rest);
    CHECK_THROWS_AS(baker.add(0.0, rest), Error);
    CHECK_THROWS_AS(baker.add(1.0, make_sphere()), Error);
    for (int f = 1; f < 16384; ++f) baker.add(f, rest);
    CHECK_THROWS_AS(baker.add(16384.0, rest), Error);
}

#endif
