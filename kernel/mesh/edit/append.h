/// Two meshes as one.
#pragma once

#include "kernel/core/context.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Adds the vertices and faces of `other` after those of `mesh`, unconnected; ids of `mesh` stay,
/// those of `other` grow by the counts of before. The topology is a new one. Attributes of both are
/// kept, NaN if a side has none. Of attributes with one name the greater width counts (an alpha
/// that is missing becomes 1), and where their domains differ both become corner attributes. Labels
/// and regions of one name are united; morph targets are paired by their names in the assets, those
/// without names by their numbers, so that "morph.N" of `other` may become another N; material
/// libraries are joined. Errors: out_of_range if the sum exceeds what Index can number; cancelled.
void append(Mesh& mesh, const Mesh& other, const Context& context = {});

}  // namespace lissom
