/// Sources of the renderer's shaders (GLSL 3.30). Space names: picture = world moved so that the
/// drawing is about the origin; view = camera coordinates with z towards the viewer; clip as OpenGL
/// has it.
#pragma once

namespace lissom::shaders {

/// The version, and functions and constants for all of them: stands before every source.
extern const char* const kCommon;

/// One triangle that covers the target; needs no vertex data.
extern const char* const kCoverVertex;

/// Surfaces: normal and depth of the front ones.
extern const char* const kGeometryVertex;
extern const char* const kGeometryFragment;
/// Openness of every pixel's surroundings, and its depth.
extern const char* const kOcclusionFragment;
/// Smooths that along one axis, within surfaces.
extern const char* const kOcclusionBlurFragment;

/// Surfaces, lit, with their edges.
extern const char* const kSurfaceVertex;
extern const char* const kSurfaceFragment;
/// Precede it if the picture has occlusion, strands that shade surfaces, edges, colours that stand
/// for numbers.
extern const char* const kHasOcclusion;
extern const char* const kHasHair;
extern const char* const kHasWire;
extern const char* const kHasValues;

/// Lines of constant width: one instance a segment, a strip of four vertices.
extern const char* const kLineVertex;
extern const char* const kLineFragment;
/// Balls of constant radius: one instance a ball, a strip of four vertices.
extern const char* const kPointVertex;
extern const char* const kPointFragment;

/// Strands: one strip of triangles through the points of packed strands, two vertices each, which
/// come from buffers.
extern const char* const kStrandVertex;
extern const char* const kStrandFragment;
/// The output of a picture whose samples were drawn with strands; as `lay_over` filters them.
extern const char* const kStrandOutputFragment;

/// Averages blocks of pixels, puts them before the background, and converts to sRGB from the top
/// left.
extern const char* const kOutputFragment;

}  // namespace lissom::shaders
