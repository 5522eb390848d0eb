/// Options of mesh files and hair files: axes, units, encodings and checks.
#pragma once

#include <functional>
#include <optional>

#include "kernel/core/geometry.h"
#include "kernel/io/stream/endianness.h"
#include "kernel/mesh/repair/repair.h"

namespace lissom {

class Mesh;

/// The axis that points up in a file. In the kernel it is y.
enum class UpAxis {
    none,  ///< as it is: nothing is turned
    y,     ///< the kernel's own convention: nothing is turned
    z,     ///< turned about x, so that the file's z is the kernel's y and its y the kernel's -z
};

/// Origin of a file.
enum class FileOrigin {
    keep,       ///< that of the mesh
    automatic,  ///< in the middle of a mesh that is farther from its origin than it is large
};

/// Compression of a glTF file. A build may lack either codec (CMake: LISSOM_MESHOPT, LISSOM_DRACO).
enum class Compression {
    none,
    meshopt,  ///< EXT_meshopt_compression: of all vertices, morph targets and indices
    /// KHR_draco_mesh_compression. Of an object with several materials each primitive has its own
    /// vertices, so that their order changes; if other vertices lie where materials meet, the
    /// object is not compressed.
    draco,
};

/// Conversion of the coordinates of a file to those of the mesh. Normals are turned but not scaled.
struct LoadOptions {
    /// Vertices at the same place that become one; if absent, Weld::all for STL, which stores each
    /// triangle by itself, and Weld::seams for all others.
    std::optional<Weld> weld = std::nullopt;
    /// False: each repair (see repair.h) is an error instead.
    bool repair = true;
    /// The file's up axis.
    UpAxis up = UpAxis::none;
    /// Length of the file's unit in the mesh's unit: positions are multiplied by it. Positive,
    /// finite.
    double unit = 1.0;
    /// Vertices that no face uses.
    UnusedVertices unused = UnusedVertices::drop;
};

/// The inverse of LoadOptions, and how the file is encoded.
struct SaveOptions {
    /// The up axis of the file.
    UpAxis up = UpAxis::none;
    /// Length of the file's unit in the mesh's unit: positions are divided by it. Positive, finite.
    double unit = 1.0;
    /// Binary or text, for formats that have both (PLY, STL). OBJ and OFF are written as text, glTF
    /// as its extension says.
    bool binary = true;
    /// Byte order of binary PLY.
    Endianness endianness = Endianness::little;
    /// The file's origin: 32-bit numbers resolve more near it. glTF keeps the place of each object
    /// in its node, but for nodes that a skin or an animation of weights uses; other formats cannot
    /// hold it, so that SavedFile and a warning of the log tell it.
    FileOrigin origin = FileOrigin::keep;
    /// Writes the normals of the surface (see vertex_normals) for a mesh that has none of its own.
    /// STL has those of its triangles in any case.
    bool normals = false;
    /// glTF only. Vertices and faces keep their order, but see Compression::draco.
    Compression compression = Compression::none;
    /// glTF only. Bits of positions, relative to the size of the object, 6 to 20: 14 keep a
    /// 16000th. Texture coordinates have as many, and directions half as many but at least 8; so
    /// have morph targets. 0 keeps all numbers. Without compression, all of them but positions are
    /// then normalised integers of 8 or 16 bits (KHR_mesh_quantization), if these are as fine and
    /// the numbers lie from -1 to 1.
    int quantize = 0;
};

/// Conversion of the coordinates of a file to those of the strands.
struct StrandLoadOptions {
    /// The file's up axis. None: that of the file (.usda), else nothing is turned. The sample files
    /// of .hair are z-up.
    UpAxis up = UpAxis::none;
    /// Length of the file's unit in metres: points and widths are multiplied by it. Positive,
    /// finite. Absent: that of the file (.usda), else 1.
    std::optional<double> unit = std::nullopt;
};

/// The inverse of StrandLoadOptions, and the checks.
struct StrandSaveOptions {
    /// The up axis of the file.
    UpAxis up = UpAxis::none;
    /// Length of the file's unit in metres: points and widths are divided by it. Positive, finite.
    double unit = 1.0;
    /// False: each change or omission for the file (see StrandFindingKind, but for content_dropped)
    /// is an error instead.
    bool mend = true;
    /// Signed distance in metres to the head; empty: it is not checked that roots come first.
    std::function<double(const Vec3&)> distance = {};
    /// For .usda: the head that the hair grew on, with a skin from its file. The strands are bound
    /// to its joints (UsdSkel). Not owned; null for none. Errors: invalid_argument for a head
    /// without a skin, strands without roots on it, and other formats; skin_mismatch for roots on
    /// objects of unlike skins.
    const Mesh* head = nullptr;
};

}  // namespace lissom
