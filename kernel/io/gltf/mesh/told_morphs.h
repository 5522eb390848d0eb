/// Names and weights of morph targets in the JSON of glTF; private to kernel/io and not installed.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/io/gltf/file/json.h"
#include "kernel/mesh/morph_asset.h"

namespace lissom {

/// Returns the targets told by the extras and the weights of a mesh; with the weights of a node in
/// place of the mesh's if it has any. Null for no node.
std::vector<MorphTarget> told_morphs(const Json& mesh, const Json* node);

/// Gives a mesh names and weights: names if any target has one, weights if any is not 0, it has
/// some, or `with_weights` is set.
void tell_morphs(Json& mesh, const std::vector<MorphTarget>& targets, bool with_weights = false);

/// Makes names and weights of a mesh those of `count` targets; none if that is 0.
void fit_morphs(Json& mesh, std::size_t count);

/// Returns the weights in the form of glTF.
Json weights_of(const std::vector<MorphTarget>& targets);

/// Returns the larger of the numbers of names and weights.
std::size_t told_morph_count(const Json& mesh);

}  // namespace lissom
