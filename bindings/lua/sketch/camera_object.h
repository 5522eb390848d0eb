/// The camera of a script.
#pragma once

#include <vector>

#include "bindings/lua/core/call.h"
#include "kernel/sketch/camera.h"

namespace lissom::lua {

struct CameraObject {
    static constexpr const char* kTypeName = "lissom.Camera";

    explicit CameraObject(const Camera& given) : camera(given) {}

    Camera camera;
};

/// A standard view as a script asks for it; view_options() describes the options.
struct ViewRequest {
    StandardView view = StandardView::three_quarter;
    FramingOptions framing = {};

    static ViewRequest read(const Call& call);
};

/// A size in pixels from a list of two integers, or one of a square; {1280, 960} if the option is
/// absent.
struct SizeRequest {
    int width = 1280, height = 960;

    static SizeRequest read(const Call& call, const char* path);
    /// Returns the option or argument "size", for the kernel.
    static PictureSize picture(const Call& call);
};

/// Options of a standard view: view, up, parallel, margin.
std::vector<Parameter> view_options();
/// The option that SizeRequest reads.
Parameter size_argument();

}  // namespace lissom::lua
