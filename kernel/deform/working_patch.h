/// The patch that a preparation works on, with its operators; private to kernel/deform.
#pragma once

#include "kernel/deform/deformer.h"
#include "kernel/deform/operators.h"
#include "kernel/deform/patch.h"

namespace lissom {

/// A patch and what follows from its shape and the options. A preparation may work on a patch with
/// more vertices than the one that a Deformer was made with: its real vertices, which come first,
/// are the same in both.
struct WorkingPatch {
    WorkingPatch(Patch from, const DeformOptions& options);

    Patch patch;
    Rings rings;
    RingGeometry geometry;
    Laplacian laplacian;
};

}  // namespace lissom
