/// Material libraries of OBJ files (MTL) as text; private to kernel/io.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lissom {

/// One material of a library.
struct MtlMaterial {
    std::string name;
    /// Kd and Ke.
    std::array<double, 3> diffuse{0.8, 0.8, 0.8}, emissive{};
    /// d (or 1 - Tr), and Pm.
    double opacity = 1.0, metalness = 0.0;
    /// Pr and Ns.
    std::optional<double> roughness, shininess;
    /// Files of map_Kd, map_Ke and norm, without their options; with '/' between folders.
    std::string diffuse_map, emissive_map, normal_map;
    /// Statements that have no member here, one line each.
    std::vector<std::string> others;
};

/// Reads a library. Statements that make no sense are passed over.
std::vector<MtlMaterial> read_mtl(std::string_view text);

/// Appends a material to the text of a library.
void write_mtl(const MtlMaterial& material, std::string& text);

/// Returns whether a line can stand among the other statements of a material.
bool is_other_mtl_statement(std::string_view line);

/// Returns whether a statement refers to a file, as "map_Ks gloss.png" does.
bool names_file(std::string_view statement);

}  // namespace lissom
