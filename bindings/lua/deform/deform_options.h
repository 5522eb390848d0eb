/// The options of lissom.deformer and lissom.deform.
#pragma once

#include <vector>

#include "bindings/lua/core/call.h"
#include "bindings/lua/deform/deform_object.h"
#include "kernel/deform/options.h"

namespace lissom::lua {

/// Returns the descriptions of the options of a deformation: its region and its method.
std::vector<Parameter> deform_parameters();

/// Makes the deformer that a call describes by the argument `mesh` and these options. Inside
/// Call::attempt only. Errors: as Deformer; invalid_argument for an option that the method has no
/// use for.
Deformer made_deformer(const Call& call, const MeshObject& mesh);

/// Returns the description of lissom.deform.
Function deform_function();

}  // namespace lissom::lua
