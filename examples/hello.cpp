// Bends a cactus: the library in one page.
//
// In CMake:
//     find_package(lissom REQUIRED)
//     target_link_libraries(hello PRIVATE lissom::kernel)
#include <iostream>

#include <lissom/deform/deformer.h>
#include <lissom/io/mesh_file.h>
#include <lissom/mesh/shapes/shapes.h>

using namespace lissom;

// Rotates `handle` by `degrees` about the z axis through its own center.
void turn(Deformer& edit, HandleId handle, double degrees) {
    edit.set_transform(handle,
                       rotation(Vec3::UnitZ(), degrees * kPi / 180.0, edit.handle_center(handle)));
}

int main() try {
    Mesh cactus = make_cactus();
    const Region& base = *cactus.find_region("base");
    const Region& tip = *cactus.find_region("tip");

    // Everything may move; the base holds its place because its handle keeps the identity.
    Deformer edit(cactus, Region::all(cactus.shared_topology()));
    edit.add_handle(base);
    const HandleId top = edit.add_handle(tip);

    // Each drag solves with factors that were made once.
    for (const double degrees : {20.0, 40.0, 60.0}) {
        turn(edit, top, degrees);
        edit.solve();
    }
    edit.apply_to(cactus);

    save_mesh(cactus, "hello.obj");
    const DeformStats& stats = edit.stats();
    std::cout << "bent " << stats.free_vertices << " vertices with " << stats.factorizations
              << " factorizations, wrote hello.obj\n";
} catch (const Error& error) {
    std::cerr << code_name(error.code()) << ": " << error.what() << '\n';
    return 1;
}
