/// Two meshes as one.
#pragma once

#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Adds the vertices and faces of `other` after those of `mesh`, unconnected; ids of `mesh` stay,
/// those of `other` grow by the counts of before. The topology is a new one. Attributes of both are
/// kept. A side without colors is white, a side without texture coordinates has 0, 0, and the
/// returned warnings name them; other attributes are NaN there. If attributes have one name, the
/// greater width counts (a missing alpha becomes 1), and if their domains differ both become corner
/// attributes. Labels and regions of one name are united; morph targets are paired by their names
/// in the assets, those without names by their numbers, so that "morph.N" of `other` may become
/// another N; material libraries are joined. Errors: out_of_range if the sum exceeds Index;
/// cancelled.
std::vector<std::string> append(Mesh& mesh, const Mesh& other, const Context& context = {});

}  // namespace lissom
