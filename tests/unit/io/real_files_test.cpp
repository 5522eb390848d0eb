// Real meshes, and files that have made other programs fail.
#include "kernel/io/stream/file.h"
#include "tests/unit/io/io_support.h"

using namespace lissom;
using namespace lissom::test;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(folder)) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    return paths;
}

// Loads every file of a folder; returns how many loaded. Whatever is thrown must be an Error.
int load_all(const fs::path& folder) {
    int loaded = 0;
    for (const fs::path& path : files_in(folder)) {
        CAPTURE(path.string());
        try {
            load_mesh(path);
            ++loaded;
        } catch (const Error& error) {
            CHECK(error.message().starts_with(display_name(path)));
        }
    }
    return loaded;
}

}  // namespace

TEST_CASE("every real model loads or says why not") {
    const auto folder = data_file("models");
    if (!folder) return;
    CHECK(load_all(*folder) > 140);
}

TEST_CASE("every nasty file loads or says why not") {
    const auto folder = data_file("nasty");
    if (!folder) return;
    CHECK(load_all(*folder) > 110);
}

TEST_CASE("real models have the vertices and faces that their origin tells") {
    struct Expected {
        const char* name;
        Index vertices, faces;
    };
    for (const Expected& expected : std::initializer_list<Expected>{
             {"models/armadillo_43k.obj", 43243, 86482},
             {"models/bff_box.obj", 26, 36},
             {"models/fairing_cross.off", 4983, 9762},
             {"models/inspired_mesh_quads_Smooth.off", 1963, 1838},
             {"models/arap_cross.off", 162, 87},
             {"models/skull_headus_20k.off", 20002, 40000},
             {"models/horse_48k.ply", 48485, 96966},
             {"models/Laurana50k.ply", 25126, 49954},
             {"models/cad_20mm_xyz_cube.stl", 132, 260},
             {"models/victorian_vase.stl", 5457, 10910},
             {"nasty/assimp_cube_binary_starts_with_nl.ply", 8, 6},
             {"nasty/draco_Box.ply", 8, 8},
             {"nasty/gc_stl_box_ascii.stl", 8, 12},
         }) {
        const auto path = data_file(expected.name);
        if (!path) continue;
        CAPTURE(expected.name);
        const Mesh mesh = load_mesh(*path);
        CHECK(mesh.vertex_count() == expected.vertices);
        CHECK(mesh.face_count() == expected.faces);
    }
}

TEST_CASE("real models are the same after save and load") {
    const TemporaryFolder folder;
    for (const char* name :
         {"models/armadillo_43k.obj", "models/camel_b.obj", "models/suzanne_quads.obj",
          "models/bff_box.obj", "models/homer.obj", "nasty/tinyobj_cornell_box.obj",
          "nasty/tinyobj_issue-138.obj", "models/horse_48k.ply", "models/Laurana50k.ply",
          "models/texturedknot.ply", "models/igea.ply", "nasty/gpy_example_cube-ascii.ply",
          "models/lion.off", "models/fairing_cross.off", "models/skull_headus_20k.off",
          "models/fertility_quad.off"}) {
        const auto path = data_file(name);
        if (!path) continue;
        CAPTURE(name);
        const Mesh mesh = load_mesh(*path);
        const fs::path copy = folder / ("copy" + path->extension().string());
        save_mesh(mesh, copy);
        Mesh loaded = load_mesh(copy);
        // Materials are written again beside a file in another folder.
        if (path->extension() == ".obj") {
            CHECK(loaded.material_libraries().size() <= 1);
            loaded.material_libraries() = mesh.material_libraries();
        }
        check_same_mesh(loaded, mesh);
    }
}

TEST_CASE("real STL models are the same after save and load") {
    const TemporaryFolder folder;
    for (const char* name : {"models/cad_20mm_xyz_cube.stl", "models/victorian_vase.stl",
                             "models/thingi_520644.stl"}) {
        const auto path = data_file(name);
        if (!path) continue;
        CAPTURE(name);
        const Mesh mesh = load_mesh(*path);
        save_mesh(mesh, folder / "copy.stl");
        check_same_geometry(load_mesh(folder / "copy.stl"), mesh);
    }
}

TEST_CASE("real models keep their geometry through other formats") {
    const auto path = data_file("models/fandisk.off");
    if (!path) return;
    const Mesh mesh = load_mesh(*path);
    for (const char* extension : {"obj", "ply", "off"}) {
        check_same_geometry(round_trip(mesh, extension), mesh);
    }
}
