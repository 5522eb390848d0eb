/// CGAL's surface mesh deformation on our meshes, as a rival for the benchmarks of deformation.
#pragma once

#include <memory>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/mesh/mesh.h"

namespace lissom::bench {

/// CGAL's energies; its default is spokes_and_rims.
enum class CgalMethod { original_arap, spokes_and_rims, sre_arap };

/// A triangle mesh of which `still` stays and `moved` follows one transform.
class CgalDeformer {
  public:
    CgalDeformer(const Mesh& mesh, CgalMethod method, const std::vector<Index>& still,
                 const std::vector<Index>& moved);
    ~CgalDeformer();
    CgalDeformer(CgalDeformer&&) noexcept;

    /// Factors.
    void preprocess();
    /// Back to the rest shape, with the identity as rotations.
    void reset();
    /// Sets where `moved` goes: rest position p to transform(p).
    void move(const Affine& transform);
    /// CGAL's own deform(): 5 iterations, or fewer where the energy changes little.
    void deform();
    /// Exactly as many iterations, from the shape that the last call left.
    void deform(int iterations);
    /// Positions of all vertices.
    std::vector<Vec3> positions() const;

    /// One energy behind the interface.
    struct Implementation;

  private:
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace lissom::bench
