/// A textured tube that bends while the engine draws: a vertex buffer with a seam of its texture.
/// The library solves each frame as a job and writes into the buffer on the graphics card.
#pragma once

#include <lissom/lissom.hpp>

#include <cstddef>
#include <cstdint>

#include "drawing.h"

namespace engine {

class Textured {
  public:
    explicit Textured(const lissom::api::Context& context);
    ~Textured();
    Textured(const Textured&) = delete;
    Textured& operator=(const Textured&) = delete;

    /// Bends the upper end by `angle` once the job before is done; the buffer shows the last frame
    /// meanwhile.
    void bend(double angle);
    /// Waits for the job that runs, and shows its frame.
    void settle();
    void draw(const Matrix& to_clip) const;

    int frames() const { return frames_; }
    std::size_t render_vertices() const { return count_; }
    int mesh_vertices() const { return lissom_mesh_vertex_count(context_, mesh_); }

  private:
    void begin(double angle);
    void finish();
    void read_frame() const;

    lissom_context* context_;
    lissom_mesh mesh_{};
    lissom_render_map map_{};
    lissom_deformer deformer_{};
    lissom_job solving_{};
    std::int32_t top_ = -1;
    std::size_t count_ = 0;
    int corners_ = 0, frames_ = 0;
    unsigned program_ = 0, array_ = 0, buffer_ = 0;
};

}  // namespace engine
