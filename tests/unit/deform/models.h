/// The real meshes that properties of deformation are tested on.
#pragma once

#include <map>
#include <string>

#include "kernel/io/mesh_file.h"
#include "tests/unit/deform/scene.h"
#include "tests/unit/support.h"

namespace lissom::test {

/// Scanned, modelled and CAD surfaces of a few hundred to a few thousand vertices, one component
/// each: closed and open, of genus up to four, of triangles and of quads, with slivers and planes.
inline constexpr const char* kModels[] = {
    "lion.off",          "cactus_cinolib.off",     "bunny_3k.off",         "cow_3k.off",
    "pelvis.obj",        "fertility.off",          "fandisk_quads.off",    "cad_block.off",
    "cad_conrod.stl",    "horse_quad.obj",         "decimated-knight.off", "stairs.off",
    "mannequin_lwu.obj", "three_holes_geogram.obj"};

/// The scene of a model, loaded once; null where the file is absent.
inline const Scene* model_scene(const std::string& name) {
    static std::map<std::string, Scene> loaded;
    const auto found = loaded.find(name);
    if (found != loaded.end()) return &found->second;
    const auto path = data_file("models/" + name);
    return path ? &loaded.emplace(name, make_scene(load_mesh(*path))).first->second : nullptr;
}

/// Calls check(scene) for every model that is there, its name captured.
template <typename Check>
void for_each_model(const Check& check) {
    for (const std::string name : kModels) {
        CAPTURE(name);
        if (const Scene* scene = model_scene(name)) check(*scene);
    }
}

}  // namespace lissom::test
