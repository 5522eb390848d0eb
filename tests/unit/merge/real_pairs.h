/// Pairs of real models that are merged at cuts by planes, as a user would set them up.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kernel/merge/merge.h"
#include "kernel/mesh/mesh.h"

namespace lissom::test {

/// One part of a model: what a plane leaves on the side of `seed`, after `subdivisions` Loop steps;
/// a model that is open as it is has no plane.
struct ModelPart {
    std::string file;
    Index subdivisions = 0;
    std::optional<Vec3> point{};
    Vec3 normal = Vec3::Zero(), seed = Vec3::Zero();
};

/// Keys are where the loops reach farthest along directions.
struct RealPair {
    std::string name;
    ModelPart source, target;
    std::vector<std::pair<Vec3, Vec3>> keys;
    /// Greatest dihedral angle across the seam, in degrees, that a result may show.
    double dihedral = 0.0;
};

const std::vector<RealPair>& real_pairs();

/// A part as a mesh with its boundary.
struct LoadedPart {
    Mesh mesh;
    Path boundary;
};

/// Nothing where the folder of test data is absent.
std::optional<LoadedPart> load_part(const ModelPart& part);

/// The vertex of a path that lies farthest along a direction.
Index farthest(const Mesh& mesh, const Path& path, const Vec3& direction);

Join join_of(const RealPair& pair, const LoadedPart& source, const LoadedPart& target);

}  // namespace lissom::test
