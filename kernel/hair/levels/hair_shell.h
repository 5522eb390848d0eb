/// The shell of hair: one closed or open surface around its volume, the coarsest of its levels.
#pragma once

#include <functional>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

inline constexpr Index kMaxShellTriangles = 1'000'000;

struct ShellOptions {
    /// Triangles wanted, 20 to kMaxShellTriangles.
    Index triangles = 2000;
    /// Metres between the places at which the density of hair is measured; details smaller than
    /// about twice as much vanish. 0.001 to 0.1; larger if the grid would have more than four
    /// million places.
    double cell = 0.005;
    /// The shell runs where hair is this part as dense as about most of its points; above 0, below
    /// 1.
    double level = 0.2;
    /// Metres between the shell and the head, at least.
    double clearance = 0.001;
    /// Signed distance in metres to the head, negative inside; empty for none: then the shell is
    /// closed. With it there is no surface below hair on the skin. Called on several threads.
    std::function<double(const Vec3&)> distance = {};
};

/// Returns the surface of hair in metres: triangles with the vertex attributes "normal" and, if the
/// strands have colours, "color": the mean of the hair there, times the light from all around that
/// reaches it. Strands that lie apart from the others, and tips of few, are outside of it. Errors:
/// invalid_argument for options out of range, if no strand has a length, and if the hair is too
/// thin for `cell`; not_finite naming strands; memory_limit; cancelled.
Mesh make_shell(const Strands& strands, const ShellOptions& options = {},
                const Context& context = {});

/// Adds skin that hair lies on too thinly for a shell, as along partings and in braided hair: a
/// surface in metres, as cut_cap makes it, with the normals and, if the strands have colours, the
/// mean of these at their roots times the light that reaches it. Errors: memory_limit; cancelled.
void add_skin(Mesh& shell, Mesh skin, const Strands& strands, const Context& context = {});

}  // namespace lissom
