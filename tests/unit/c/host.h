/// A host of the C ABI for tests: a context, and meshes of the kernel through its interface.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "bindings/c/lissom.h"
#include "kernel/mesh/mesh.h"

namespace lissom::test {

/// Copies a mesh of the kernel through the interface: the context has the kernel's space.
inline lissom_mesh add_mesh(lissom_context* context, const Mesh& mesh) {
    std::vector<Index> corners, sizes;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.topology().face(f);
        corners.insert(corners.end(), face.begin(), face.end());
        sizes.push_back(count_of(face));
    }
    const lissom_input p{mesh.positions().data(), mesh.positions().size(), sizeof(Vec3),
                         LISSOM_FLOAT64};
    const lissom_input c{corners.data(), corners.size(), 0, LISSOM_INT32};
    const lissom_input s{sizes.data(), sizes.size(), 0, LISSOM_INT32};
    lissom_mesh handle{};
    REQUIRE(lissom_mesh_create(context, &p, &c, &s, &handle) == LISSOM_OK);
    return handle;
}

class Host {
  public:
    explicit Host(const lissom_context_options& options = lissom_default_context_options()) {
        REQUIRE(lissom_context_create(&options, &context_) == LISSOM_OK);
    }
    ~Host() { lissom_context_destroy(context_); }
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    operator lissom_context*() const { return context_; }

    std::string message() const { return lissom_last_error(context_)->message; }

    /// A copy of a mesh of the kernel, see `add_mesh`.
    lissom_mesh add(const Mesh& mesh) const { return add_mesh(context_, mesh); }

    std::vector<Vec3> positions(lissom_mesh mesh) const {
        std::vector<Vec3> points(at(lissom_mesh_vertex_count(context_, mesh)));
        const lissom_output out{points.data(), points.size(), sizeof(Vec3), LISSOM_FLOAT64};
        REQUIRE(lissom_mesh_read_positions(context_, mesh, &out) == LISSOM_OK);
        return points;
    }

    std::uint64_t hash(lissom_mesh mesh) const {
        std::uint64_t value = 0;
        REQUIRE(lissom_mesh_hash(context_, mesh, &value) == LISSOM_OK);
        return value;
    }

  private:
    lissom_context* context_ = nullptr;
};

/// The transform of a map.
inline lissom_transform transform_of(const Affine& map) {
    lissom_transform result{};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            result.m[4 * row + column] = map.linear(row, column);
        }
        result.m[4 * row + 3] = map.translation[row];
    }
    return result;
}

}  // namespace lissom::test
