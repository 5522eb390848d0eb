/// Common part of the readers of OFF in text and in binary; private to kernel/io.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/io/record/color_reader.h"
#include "kernel/io/record/finite_values.h"
#include "kernel/io/record/index_check.h"
#include "kernel/io/record/mesh_data.h"
#include "kernel/io/stream/text_reader.h"
#include "kernel/mesh/attributes.h"

namespace lissom {

/// Values of the vertices beside positions, in the order of the file.
struct OffLayout {
    bool normals = false, colors = false, uvs = false;

    /// Numbers of a vertex without its colour.
    std::size_t numbers_without_color() const { return 3 + (normals ? 3u : 0u) + (uvs ? 2u : 0u); }
};

/// Collects vertices and faces.
struct OffBuilder {
    OffLayout layout;
    ScalarType number_type = ScalarType::float64;
    std::size_t vertex_count = 0, face_count = 0;
    MeshData mesh;
    std::vector<double> normals, uvs;
    ColorReader vertex_colors, face_colors;
    IndexCheck vertices{"vertex", 0};
    std::vector<Index> face;

    /// Reads a vertex by next(), which gives the next number.
    template <typename Next>
    void add_vertex(std::size_t color_width, const Next& next) {
        const double x = next(), y = next(), z = next();
        if (layout.normals) {
            for (int k = 0; k < 3; ++k) normals.push_back(next());
        }
        if (color_width > 0) {
            std::array<double, 4> color{};
            for (std::size_t k = 0; k < color_width; ++k) color[k] = next();
            vertex_colors.set(mesh.positions.size(), {color.data(), color_width});
        }
        if (layout.uvs) {
            for (int k = 0; k < 2; ++k) uvs.push_back(next());
        }
        mesh.positions.emplace_back(x, y, z);
    }

    /// Returns the mesh of the collected data. Errors: face_index.
    MeshData finish() {
        vertices.require_below(mesh.positions.size());
        add("normal", 3, std::move(normals));
        vertex_colors.finish(mesh.attributes, Domain::vertex, mesh.positions.size());
        add("uv", 2, std::move(uvs));
        face_colors.finish(mesh.attributes, Domain::face, at(mesh.faces.size()));
        drop_infinite_values(mesh.attributes, mesh.report);
        return std::move(mesh);
    }

    void add(const char* name, Index width, std::vector<double> values) {
        if (values.empty()) return;
        mesh.attributes.add({name, Domain::vertex, width, number_type, std::move(values)});
    }
};

/// Reads the counts and the data in text, with any line breaks; see `read_off`.
MeshData read_off_text(const TextReader& text, std::size_t file_bytes, OffLayout layout,
                       const Context& context);

/// Reads the data after the line of the keyword.
MeshData read_off_binary(std::string_view bytes, OffLayout layout, const Context& context);

}  // namespace lissom
