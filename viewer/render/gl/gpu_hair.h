/// GpuHair: strands on the graphics card, for a window: any number of the first of an even order
/// can be drawn, from any side, and nothing is sent while the camera moves. All of it needs a
/// current context, also to end.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "viewer/render/draw/view_parameters.h"
#include "viewer/render/gl/gl_objects.h"
#include "viewer/render/gl/hair_shadow.h"
#include "viewer/render/strands/hair_light.h"
#include "viewer/render/strands/packed_strands.h"

namespace lissom {

/// Strands of a drawing, ready to be drawn.
struct HairPart {
    DrawnStrands drawn;
    std::shared_ptr<const PackedStrands> packed;
};

/// All strands of a drawing, and their light; `light` is null if there are none.
struct Hair {
    std::vector<HairPart> parts;
    std::shared_ptr<const HairLight> light;
};

/// Strands from the `begin`-th to before the `end`-th, as shares of them all: with several parts,
/// of each the same share.
struct HairRange {
    double begin = 0.0, end = 1.0;
    /// Fraction of strands that stand for all: they are so much wider.
    double of = 1.0;
    /// Draw the few points of strands meant for moving pictures, if they suffice.
    bool few_points = false;
};

/// View of the strands.
struct HairView {
    /// Camera of the picture; the projection may be that of a part of it.
    ViewParameters parameters;
    Mat4 projection = Mat4::Identity();
    /// The point of the world that is at zero in picture space.
    Vec3 origin = Vec3::Zero();
    /// Strands are at least so wide, in view units, at depth 1 with perspective.
    double thinnest = 0.0;
};

class GpuHair {
  public:
    GpuHair();

    /// Replaces the content by `hair`; sends its new parts and frees unused ones. Returns the bytes
    /// sent. Errors: memory_limit.
    std::size_t update(const Hair& hair);
    /// Uses the light for one camera from now on: `light` is HairLight::directed of the current
    /// light; nothing if there is none. Returns the bytes sent.
    std::size_t direct(std::span<const std::uint8_t> light);
    /// Uses the light for any camera from now on, by its moments.
    void undirect() { directed_ = false; }

    bool empty() const { return size_ == 0; }
    /// Return the number of strands drawn in all, and of strands that have few points.
    Index size() const { return size_; }
    double few() const { return few_; }
    /// Returns whether all strands are there, not few alone.
    bool complete() const { return complete_; }
    /// Returns metres in the world of the widest strand when a share `of` of them is drawn.
    double width(double of) const;
    /// Returns the middle of the light's grid.
    Vec3 middle() const;
    const std::shared_ptr<const HairLight>& light() const { return light_; }

    /// Returns the shade on meshes.
    GpuHairShade shade(const HairView& view) const;
    /// Draws into the bound framebuffer, against its depths.
    void draw(const HairView& view, const HairRange& range) const;

  private:
    // Whole strands, as many as one buffer holds.
    struct Page {
        gl::TextureBuffer points, shifts;
        Index first = 0, last = 0;
        Index base = 0;
    };
    struct Ribbons {
        std::vector<Page> pages;
        std::vector<Index> offsets{0};

        Index size() const { return count_of(offsets) - 1; }
    };
    struct Part {
        HairPart source;
        std::shared_ptr<const Ribbons> all, few;
    };

    std::shared_ptr<const Ribbons> send(const PackedRibbons& packed, std::size_t& sent) const;
    std::size_t update_light(std::shared_ptr<const HairLight> light);
    void count();
    void use(const HairView& view) const;
    void use(const Part& part, const HairView& view, double widening) const;
    static Index count_of_part(const Part& part, double share);
    static Index total(const Part& part);

    gl::Program program_;
    gl::VertexArray no_vertices_;
    Index max_points_ = 0;
    std::vector<Part> parts_;
    std::shared_ptr<const HairLight> light_;
    std::shared_ptr<const gl::Texture> volume_, for_strands_, for_meshes_;
    GpuHairShade no_hair_;
    Index size_ = 0;
    double few_ = 0.0;
    bool complete_ = false;
    bool directed_ = false;
};

}  // namespace lissom
