/// Vertex animation textures: a sequence of shapes of one mesh as two pictures, which a vertex
/// shader reads. Each texel is a vertex in one frame; frames stand below one another, so that a
/// bilinear sampler blends between them.
///
///     VertexTextureBaker baker(mesh);
///     baker.add(time, shape);  // for each frame
///     save_vertex_texture(baker.finish(), {"sway.glb", "sway.json", "sway_p.png", "sway_n.png"});
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Frames as pictures of 16 bits a channel. Vertex v stands in column v % width; its frames are the
/// rows from v / width * frame count on.
struct VertexTexture {
    /// The shape at rest, with the texture coordinates of each vertex's first frame.
    Mesh mesh;
    /// Name of the attribute with these coordinates: "uv2" as a rule.
    std::string coordinates;
    /// Times of the frames in seconds.
    std::vector<double> times;
    Index width = 0, height = 0;
    /// Red, green and blue, row after row from the top: positions from the least to the greatest
    /// corner of `bounds`, and unit normals from -1 to 1.
    std::vector<std::uint16_t> positions, normals;
    Box bounds;
    /// Greatest distance of a position from the shape's, in mesh units, and of a normal.
    double max_error = 0.0, max_normal_error = 0.0;

    /// Returns a position and a normal as a shader reads them.
    Vec3 position(Index vertex, Index frame) const;
    Vec3 normal(Index vertex, Index frame) const;
};

/// Collects shapes for a texture.
class VertexTextureBaker {
  public:
    /// Errors: unsupported for a mesh without faces; memory_limit.
    explicit VertexTextureBaker(const Mesh& rest, Context context = {});

    /// Adds a frame: the positions of `shape` and the normals of its surface, or its own normals if
    /// it has some for its vertices. Errors: topology_mismatch; invalid_argument for times that are
    /// not finite and ascending, and for more frames than a picture of 16384 rows has room for;
    /// not_finite; memory_limit; cancelled.
    void add(double time, const Mesh& shape);

    /// Returns the pictures. Errors: invalid_argument without a frame; memory_limit; cancelled.
    VertexTexture finish() const;

  private:
    Mesh rest_;
    Context context_;
    std::vector<double> times_;
    // Positions and normals of all vertices, frame after frame.
    std::vector<std::vector<Vec3>> positions_, normals_;
    std::vector<MemoryCharge> charges_;
};

/// Files of a texture: the mesh as glTF, its description as JSON, and two pictures as PNG.
struct VertexTextureFiles {
    std::filesystem::path mesh, description, positions, normals;
};

/// Writes the files, each whole or not at all; the description names the pictures. Errors: as
/// save_mesh; file_too_large; file_write_failed; cancelled.
void save_vertex_texture(const VertexTexture& texture, const VertexTextureFiles& files,
                         const Context& context = {});

}  // namespace lissom
