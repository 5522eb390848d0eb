#include "kernel/io/basis_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/deform/deformed_surface.h"
#include "kernel/deform/handle_basis.h"
#include "kernel/io/stream/byte_reader.h"
#include "kernel/io/stream/file.h"
#include "kernel/io/stream/file_error.h"
#include "kernel/io/stream/read_error.h"
#include "kernel/io/stream/scalar.h"

namespace lissom {
namespace {

using Eigen::Vector3f;
using Eigen::Vector4f;

constexpr std::string_view kMagic = "LSMBASIS";
constexpr std::uint32_t kBasisVersion = 1;
constexpr std::size_t kHeaderBytes = 64;
// A handle; a vertex with its rest position; the weights of a handle at a vertex.
constexpr std::size_t kUnitBytes = 16;

// ---- From a deformer

// The nearest 32-bit number in each coordinate, so that engines place the origin exactly.
Vec3 middle_of(const std::vector<Vec3>& points) {
    Box box;
    for (const Vec3& p : points) box.extend(p);
    return box.center().cast<float>().cast<double>();
}

void require_floats(const EngineBasis& basis) {
    Elements beyond{ElementKind::vertex, 0, {}};
    for (std::size_t row = 0; row < basis.vertices.size(); ++row) {
        bool finite = basis.rest[row].allFinite();
        for (const auto& weights : basis.weights) finite = finite && weights[row].allFinite();
        if (!finite) beyond.add(basis.vertices[row]);
    }
    if (beyond.count == 0 && basis.origin.allFinite() && std::isfinite(basis.size)) return;
    const std::string names = beyond.count > 0 ? describe(beyond) : "the surface";
    throw Error(ErrorCode::not_finite,
                names + ": values exceed the range of 32-bit numbers; scale the mesh down",
                std::move(beyond));
}

std::vector<EngineHandle> named_handles(const Deformer& deformer, const HandleBasis& basis,
                                        std::span<const std::string> names, const Vec3& origin) {
    if (names.size() > basis.handles.size()) {
        throw Error(ErrorCode::invalid_argument, std::to_string(names.size()) + " names for " +
                                                     std::to_string(basis.handles.size()) +
                                                     " handles");
    }
    std::vector<EngineHandle> handles(basis.handles.size());
    for (std::size_t h = 0; h < handles.size(); ++h) {
        if (h < names.size()) handles[h].name = names[h];
        handles[h].center = (deformer.handle(basis.handles[h]).center - origin).cast<float>();
    }
    return handles;
}

// ---- Bytes

class ByteWriter {
  public:
    template <typename T>
    void add(T value) {
        append_number(bytes_, value, Endianness::little);
    }
    template <typename Vector>
    void add_vector(const Vector& v) {
        for (const auto x : v) add(x);
    }
    void add_text(std::string_view text) { bytes_ += text; }
    void reserve(std::size_t bytes) { bytes_.reserve(bytes); }
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

std::uint64_t block_bytes(std::size_t handles, std::size_t vertices) {
    return std::uint64_t{kUnitBytes} * (handles + vertices + handles * vertices);
}

void require_consistent(const EngineBasis& basis) {
    const std::size_t rows = basis.vertices.size();
    bool fits = basis.rest.size() == rows && basis.weights.size() == basis.handles.size();
    for (const auto& weights : basis.weights) fits = fits && weights.size() == rows;
    for (std::size_t i = 0; i < rows; ++i) {
        const Index v = basis.vertices[i];
        fits = fits && v > (i > 0 ? basis.vertices[i - 1] : -1) && v < basis.mesh_vertex_count;
    }
    if (!fits) {
        throw Error(ErrorCode::invalid_argument,
                    "vertices, rest positions, handles and weights of the basis do not fit each "
                    "other");
    }
    for (const EngineHandle& handle : basis.handles) {
        if (handle.name.find('\0') == std::string::npos) continue;
        throw Error(ErrorCode::invalid_argument, "the name of a handle has a zero byte in it");
    }
    require_floats(basis);
}

std::string joined_names(const EngineBasis& basis) {
    std::string names;
    for (const EngineHandle& handle : basis.handles) names += handle.name + '\0';
    return names;
}

struct Header {
    std::uint32_t handles = 0, vertices = 0, mesh_vertices = 0, names = 0;
    float size = 0.0f;
    Vec3 origin = Vec3::Zero();
    std::uint64_t bytes = 0;
};

[[noreturn]] void refuse_damaged(const std::string& what) {
    refuse(ErrorCode::file_syntax, what + "; the file is damaged, save the basis again");
}

void require_magic(std::string_view bytes) {
    if (!bytes.starts_with(kMagic.substr(0, bytes.size()))) {
        refuse(ErrorCode::file_syntax, "this is not a basis file");
    }
    if (bytes.size() < kHeaderBytes) refuse_truncated({"bytes of the header", bytes.size(), 64});
}

void require_sizes(const Header& header, std::size_t file_bytes) {
    constexpr std::uint32_t kMost = std::numeric_limits<Index>::max();
    const std::uint64_t units = file_bytes / kUnitBytes, n = header.vertices, h = header.handles;
    if (header.bytes > file_bytes) {
        refuse_truncated({"bytes", file_bytes, static_cast<std::size_t>(header.bytes)});
    }
    const bool fits = n <= units && h <= units && (n == 0 || h <= units / n) &&
                      kHeaderBytes + block_bytes(h, n) + header.names == file_bytes;
    if (!fits || header.bytes != file_bytes) {
        refuse_damaged("the sizes in the header do not fit the file");
    }
    if (header.mesh_vertices > kMost) refuse_damaged("the mesh has too many vertices");
}

Header read_header(std::string_view bytes, ByteReader& reader) {
    require_magic(bytes);
    reader.skip(kMagic.size());
    if (const auto version = reader.read<std::uint32_t>(); version != kBasisVersion) {
        refuse(ErrorCode::unsupported, "the basis file has version " + std::to_string(version) +
                                           ", known is " + std::to_string(kBasisVersion));
    }
    Header header;
    header.handles = reader.read<std::uint32_t>();
    header.vertices = reader.read<std::uint32_t>();
    header.mesh_vertices = reader.read<std::uint32_t>();
    header.names = reader.read<std::uint32_t>();
    header.size = reader.read<float>();
    for (double& x : header.origin) x = reader.read<double>();
    header.bytes = reader.read<std::uint64_t>();
    require_sizes(header, bytes.size());
    if (!header.origin.allFinite() || !std::isfinite(header.size) || header.size < 0.0f) {
        refuse(ErrorCode::not_finite, "the origin or the size of the basis is no number");
    }
    return header;
}

template <typename Vector>
Vector read_vector(ByteReader& reader) {
    Vector v;
    for (float& x : v) x = reader.read<float>();
    if (!v.allFinite()) refuse(ErrorCode::not_finite, "a number of the basis is NaN or infinite");
    return v;
}

std::vector<Index> read_vertices(const Header& header, ByteReader& reader) {
    std::vector<Index> vertices(header.vertices);
    std::uint32_t least = 0;
    for (Index& v : vertices) {
        const auto id = reader.read<std::uint32_t>();
        if (id < least || id >= header.mesh_vertices) {
            refuse_damaged("the vertices of the basis do not ascend within the mesh");
        }
        least = id + 1;
        v = static_cast<Index>(id);
    }
    return vertices;
}

// `names` begin at each handle's offset.
void set_names(std::string_view names, std::span<const std::uint32_t> starts,
               std::vector<EngineHandle>& handles) {
    if (!names.empty() && names.back() != '\0') refuse_damaged("the last name has no end");
    for (std::size_t h = 0; h < handles.size(); ++h) {
        const std::size_t start = starts[h], end = names.find('\0', start);
        if (start >= names.size() || end == std::string_view::npos) {
            refuse_damaged("the name of a handle lies outside the names");
        }
        handles[h].name = names.substr(start, end - start);
    }
}

}  // namespace

std::vector<Vec3> EngineBasis::positions(std::span<const Affine> transforms) const {
    if (transforms.size() != handles.size()) {
        throw Error(ErrorCode::invalid_argument, std::to_string(transforms.size()) +
                                                     " transforms for " +
                                                     std::to_string(handles.size()) + " handles");
    }
    std::vector<Vec3> result;
    for (const Vector3f& p : rest) result.push_back(origin + p.cast<double>());
    for (std::size_t h = 0; h < handles.size(); ++h) {
        const Mat3 turn = transforms[h].linear - Mat3::Identity();
        const Vec3 shift = turn * origin + transforms[h].translation;
        for (std::size_t row = 0; row < rest.size(); ++row) {
            const Vec4 w = weights[h][row].cast<double>();
            result[row] += turn * w.head<3>() + shift * w[3];
        }
    }
    return result;
}

EngineBasis make_engine_basis(Deformer& deformer, std::span<const std::string> names,
                              const Context& context) {
    const HandleBasis exact = basis_of(deformer, context);
    EngineBasis basis;
    basis.origin = middle_of(rest_positions_of(deformer));
    const Vec3& o = basis.origin;
    basis.mesh_vertex_count = deformer.region().topology()->vertex_count();
    basis.vertices = exact.vertices;
    basis.handles = named_handles(deformer, exact, names, o);

    // With the identity a handle adds the first three of its weights.
    std::vector<Vec3> rest = exact.fixed;
    for (const std::vector<Vec4>& weights : exact.weights) {
        std::vector<Vector4f>& narrow = basis.weights.emplace_back();
        for (std::size_t row = 0; row < rest.size(); ++row) {
            Vec4 w = weights[row];
            rest[row] += w.head<3>();
            w.head<3>() -= w[3] * o;
            narrow.push_back(w.cast<float>());
        }
    }
    for (const Vec3& p : rest) {
        basis.rest.push_back((p - o).cast<float>());
        basis.size = std::max(basis.size, static_cast<float>((p - o).norm()));
    }
    require_consistent(basis);
    return basis;
}

std::string encode_basis(const EngineBasis& basis) {
    require_consistent(basis);
    const std::string names = joined_names(basis);
    const std::uint64_t bytes =
        kHeaderBytes + block_bytes(basis.handles.size(), basis.vertices.size()) + names.size();
    ByteWriter writer;
    writer.reserve(static_cast<std::size_t>(bytes));
    writer.add_text(kMagic);
    writer.add(kBasisVersion);
    writer.add(static_cast<std::uint32_t>(basis.handles.size()));
    writer.add(static_cast<std::uint32_t>(basis.vertices.size()));
    writer.add(static_cast<std::uint32_t>(basis.mesh_vertex_count));
    writer.add(static_cast<std::uint32_t>(names.size()));
    writer.add(basis.size);
    writer.add_vector(basis.origin);
    writer.add(bytes);
    std::uint32_t name = 0;
    for (const EngineHandle& handle : basis.handles) {
        writer.add_vector(handle.center);
        writer.add(name);
        name += static_cast<std::uint32_t>(handle.name.size()) + 1;
    }
    for (const Index v : basis.vertices) writer.add(static_cast<std::uint32_t>(v));
    for (const Vector3f& p : basis.rest) writer.add_vector(p);
    for (const auto& weights : basis.weights) {
        for (const Vector4f& w : weights) writer.add_vector(w);
    }
    writer.add_text(names);
    return writer.take();
}

EngineBasis decode_basis(std::string_view bytes) {
    ByteReader reader(bytes, Endianness::little);
    reader.tally = {"numbers of the basis", 0, 0};
    const Header header = read_header(bytes, reader);
    EngineBasis basis;
    basis.origin = header.origin;
    basis.size = header.size;
    basis.mesh_vertex_count = static_cast<Index>(header.mesh_vertices);
    basis.handles.resize(header.handles);
    std::vector<std::uint32_t> names;
    for (EngineHandle& handle : basis.handles) {
        handle.center = read_vector<Vector3f>(reader);
        names.push_back(reader.read<std::uint32_t>());
    }
    basis.vertices = read_vertices(header, reader);
    basis.rest.resize(header.vertices);
    for (Vector3f& p : basis.rest) p = read_vector<Vector3f>(reader);
    basis.weights.assign(header.handles, std::vector<Vector4f>(header.vertices));
    for (auto& weights : basis.weights) {
        for (Vector4f& w : weights) w = read_vector<Vector4f>(reader);
    }
    set_names(bytes.substr(bytes.size() - header.names), names, basis.handles);
    return basis;
}

void save_basis(const EngineBasis& basis, const std::filesystem::path& path,
                const Context& context) {
    write_file_atomically(path, encode_basis(basis), context);
}

EngineBasis load_basis(const std::filesystem::path& path, const Context& context) {
    const FileContent content = read_file(path, context);
    try {
        return decode_basis(content.bytes);
    } catch (const Error& error) {
        const std::string file = display_name(path);
        throw FileError(error.code(), file, file + ": " + error.message(), error.elements());
    }
}

}  // namespace lissom
