// Bends a cactus: the library in one page.
//
// In CMake:
//     find_package(lissom REQUIRED)
//     target_link_libraries(hello PRIVATE lissom::kernel)
#include <iostream>

#include <lissom/deform/deformer.h>
#include <lissom/deform/stats.h>
#include <lissom/io/mesh_file.h>
#include <lissom/mesh/shapes/shapes.h>

using namespace lissom;

int main() try {
    Mesh cactus = make_cactus();
    // Everything may move but the base.
    Deformer deformer(cactus);
    deformer.pin(cactus.region("base"));
    const HandleId top = deformer.add_handle(cactus.region("tip"));

    // Each drag solves with factors that were made once.
    for (int step = 0; step < 3; ++step) {
        deformer.rotate(top, Vec3::UnitZ(), 20.0 * kPi / 180.0);
        deformer.solve();
    }
    deformer.apply_to(cactus);

    save_mesh(cactus, "hello.obj");
    const DeformStats stats = stats_of(deformer);
    std::cout << "bent " << stats.free_vertices << " vertices with " << stats.factorizations
              << " factorizations, wrote hello.obj\n";
} catch (const Error& error) {
    std::cerr << code_name(error.code()) << ": " << error.what() << '\n';
    return 1;
}
