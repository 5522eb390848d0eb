/// Objects drawn by the engine: static surfaces, surfaces that a basis moves on the graphics card,
/// strands.
#pragma once

#include <lissom/lissom_basis.h>
#include <lissom/lissom.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace engine {

using Matrix = std::array<float, 16>;  // column after column, as OpenGL has it
using Color = std::array<float, 3>;

/// Triangles of a mesh. With a basis its vertex shader, basis.vert, moves them by the handles.
class Surface {
  public:
    Surface(const lissom::api::Mesh& mesh, const std::string& vertex_shader,
            const lissom_basis* basis = nullptr);
    /// `transforms`: 12 floats a handle, relative to the origin of the basis; null without one.
    void draw(const Matrix& to_clip, const Color& color, const float* transforms = nullptr) const;

  private:
    unsigned program_ = 0, array_ = 0, weights_ = 0;
    int corner_count_ = 0, row_count_ = 0, handle_count_ = 0;
};

/// Strands as lines, lit as thin cylinders.
class Hair {
  public:
    explicit Hair(const lissom::api::Strands& strands);
    void draw(const Matrix& to_clip, const Color& color) const;

  private:
    unsigned program_ = 0, array_ = 0;
    std::vector<int> firsts_, counts_;
};

void clear_picture();

/// Returns a program of two shaders. Errors: std::runtime_error with their log.
unsigned make_program(const std::string& vertex, const std::string& fragment);

}  // namespace engine
