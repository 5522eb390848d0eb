/// Text around the curves of a RIB file, so that a renderer can make the picture alone: a camera,
/// lights, and the head; private to kernel/io.
#pragma once

#include <string>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/io/hair/rib_options.h"
#include "kernel/sketch/camera.h"

namespace lissom {

/// Writes a scene: first the part before the hair, then its end. Coordinates are those of the file.
class RibSceneWriter {
  public:
    /// `hair` bounds the strands in metres, `placement` takes metres to the file. A unit that is
    /// absent is 1. Errors: as Camera; invalid_argument for a size or unit that is not positive.
    RibSceneWriter(const RibScene& scene, const Box& hair, const Affine& placement,
                   const Context& context);

    /// Display, camera, lights, head, and the shader of the hair.
    void begin(std::string& text) const;
    static void end(std::string& text);

  private:
    void write_camera(std::string& text) const;
    void write_lights(std::string& text) const;
    void write_head(std::string& text) const;

    const RibScene& scene_;
    const Context& context_;
    /// Maps from the head's units to the file, and from metres.
    Affine of_head_, of_metres_;
    /// Camera in the file's coordinates.
    Camera camera_;
    double near_ = 0.0, far_ = 0.0;
};

}  // namespace lissom
