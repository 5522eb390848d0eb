// All of the kernel by its one header: something of each module.
#include <lissom/kernel.h>

int main() {
    const lissom::Camera camera;
    lissom::Scene scene;
    lissom::Mesh head = lissom::make_head();
    lissom::Strands hair;
    lissom::Deformer edit(head, lissom::Region::all(head.shared_topology()));
    lissom::save_mesh(head, "head.obj");
    return lissom::load_mesh("head.obj").vertex_count() == head.vertex_count() ? 0 : 1;
}
