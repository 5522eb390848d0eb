/// Materials with pictures for meshes that have none, as hair cards.
#pragma once

#include <string>

#include "kernel/mesh/mesh.h"

namespace lissom {

/// A material of glTF with pictures inside the file.
struct TexturedMaterial {
    /// The label "material" of its faces.
    std::string name = "hair";
    /// PNG files: colour with alpha; the second may be empty: it is kept beside the material for
    /// engines, as the texture of its extras "flow".
    std::string color_png, flow_png;
    /// Alpha below it is not drawn.
    double cutoff = 0.5;
    double roughness = 0.6;
    /// Strength and sharpness of reflections along hair, by KHR_materials_anisotropy; 0 for none.
    double anisotropy = 0.7;
};

/// Gives a mesh the material, so that it is saved to glTF files with it. Both sides are drawn.
/// Errors: unsupported if the mesh has contents of a file beside its surface already.
void set_material(Mesh& mesh, const TexturedMaterial& material);

}  // namespace lissom
