/// Basis files: the first system's solution of a deformation in floats, for programs that move
/// handles but have no solver. bindings/engine/lissom_basis.h describes the layout, and evaluates
/// it in C.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/deform/deformer.h"
#include "kernel/io/basis_keys.h"

namespace lissom {

/// A handle as it is saved.
struct EngineHandle {
    std::string name;
    /// Mean of its rest positions, relative to the origin.
    Eigen::Vector3f center = Eigen::Vector3f::Zero();
};

/// position(v) = origin + rest(v) + sum over h of (T_h - I) weight(h, v), for handle transforms T_h
/// relative to the origin. In this form floats suffice at any distance of the mesh from its own
/// origin, and handles at the identity give the rest shape to the bit.
struct EngineBasis {
    /// Middle of the region's rest positions, each coordinate a 32-bit number.
    Vec3 origin = Vec3::Zero();
    /// Greatest distance of a rest position from the origin.
    float size = 0.0f;
    Index mesh_vertex_count = 0;
    /// Vertices of the region, ascending; one row of the basis each.
    std::vector<Index> vertices;
    std::vector<EngineHandle> handles;
    /// Positions of the vertices while no handle moves, relative to the origin.
    std::vector<Eigen::Vector3f> rest;
    /// Weights: for each handle one 4-vector a row.
    std::vector<std::vector<Eigen::Vector4f>> weights;
    /// Corrections at key poses; empty for the basis alone.
    EngineKeys keys;

    /// Returns positions for transforms of the mesh's space, one a handle, with the corrections.
    /// Errors: invalid_argument for another number of transforms.
    std::vector<Vec3> positions(std::span<const Affine> transforms) const;
};

/// Returns the basis of a deformer with its present handles and constraints. `names` are those of
/// the handles in their order; handles beyond them have none. Errors: as Deformer::prepare;
/// invalid_argument for more names than handles, or a name with a zero byte; not_finite naming
/// vertices whose values exceed the range of floats.
EngineBasis make_engine_basis(Deformer& deformer, std::span<const std::string> names = {},
                              const Context& context = {});

/// Adds corrections, so that at each key the positions are those of the key, and between them the
/// offsets are blended by the pose; see EngineKeys. Replaces keys that the basis had. Errors:
/// invalid_argument for more than kMaxBasisKeys, for keys that do not fit the basis, and for two of
/// the same pose.
void set_keys(EngineBasis& basis, std::span<const BasisKey> keys);

/// Writes a basis file, whole or not at all. Errors: file_write_failed, file_is_directory;
/// invalid_argument if the lists do not fit each other; cancelled.
void save_basis(const EngineBasis& basis, const std::filesystem::path& path,
                const Context& context = {});

/// Reads a basis file. Errors: file_not_found, file_is_directory, file_empty, file_unreadable;
/// file_truncated; file_syntax for other files or contradictions; unsupported for another version;
/// not_finite; memory_limit, cancelled.
EngineBasis load_basis(const std::filesystem::path& path, const Context& context = {});

/// Returns the bytes of `save_basis`.
std::string encode_basis(const EngineBasis& basis);

/// Loads as `load_basis` does, from memory.
EngineBasis decode_basis(std::string_view bytes);

}  // namespace lissom
