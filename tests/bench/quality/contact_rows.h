/// Rows of contacts: how many pairs of faces run through one another with and without pushing, its
/// price in energy, and the cost of finding them beside a fit of the boxes.
#pragma once

#include "kernel/mesh/mesh.h"
#include "tests/bench/report.h"

namespace lissom::bench {

/// Generated shapes, and the armadillo if it is given.
void add_contact_rows(Report& report, const Mesh* armadillo);

}  // namespace lissom::bench
