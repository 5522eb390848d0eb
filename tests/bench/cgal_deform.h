/// CGAL's surface mesh deformation on our meshes, as a rival for the benchmark of deformation.
#pragma once

#include <functional>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/mesh/mesh.h"

namespace lissom::bench {

enum class CgalMethod { original_arap, sre_arap };

struct CgalTimes {
    double preprocess = 0.0, frame = 0.0;
};

/// Deforms a triangle mesh with the given control vertices. `move(frame)` is the transform of
/// `moved` in each of `frames` frames; `still` stays. Every frame runs CGAL's default deform().
/// Seconds; frame is the median.
CgalTimes time_cgal(const Mesh& mesh, CgalMethod method, const std::vector<Index>& still,
                    const std::vector<Index>& moved, int frames,
                    const std::function<Affine(int)>& move);

}  // namespace lissom::bench
