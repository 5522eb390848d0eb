// Seams and self-intersections of scanned and modelled surfaces.

#include "kernel/io/mesh_file.h"
#include "kernel/merge/sew.h"
#include "kernel/mesh/self_intersections.h"
#include "kernel/mesh/triangulate.h"
#include "tests/unit/merge/seam_scenes.h"
#include "tests/unit/support.h"

using namespace lissom;
using namespace lissom::test;

TEST_CASE("self-intersections of real meshes: those that they are known to have") {
    for (const char* name : {"models/cow_3k.off", "models/camel_isoblend.obj"}) {
        const auto path = data_file(name);
        if (!path) return;
        Mesh mesh = load_mesh(*path);
        triangulate(mesh);
        const std::vector<FacePair> pairs = self_intersections(mesh);
        MESSAGE(name << ": " << mesh.face_count() << " faces, " << pairs.size() << " pairs");
        CHECK(!pairs.empty());
        CHECK(pairs.size() < 400);
    }
}
