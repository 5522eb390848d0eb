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

constexpr std::string_view kKeysMagic = "LSMBKEYS";
constexpr std::size_t kKeysHeaderBytes = 32;
// Numbers of a pose for each handle.
constexpr std::size_t kPoseNumbers = 12;

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

bool have_fitting_sizes(const EngineBasis& basis) {
    const EngineKeys& keys = basis.keys;
    const Eigen::Index axes = keys.axes.rows(), nodes = keys.nodes.rows();
    const auto count = static_cast<Eigen::Index>(keys.corrections.size());
    const auto numbers = static_cast<Eigen::Index>(kPoseNumbers * basis.handles.size());
    bool fits = keys.corrections.size() <= kMaxBasisKeys && nodes >= count && nodes <= count + 1;
    fits = fits && keys.axes.cols() == numbers && axes <= count && keys.nodes.cols() == axes;
    fits = fits && keys.min.size() == axes && keys.max.size() == axes;
    fits = fits && keys.blend.rows() == nodes + axes + 1 && keys.blend.cols() == count;
    for (const auto& offsets : keys.corrections) {
        fits = fits && offsets.size() == basis.vertices.size();
    }
    return fits;
}

void require_consistent_keys(const EngineBasis& basis) {
    const EngineKeys& keys = basis.keys;
    if (keys.empty()) return;
    if (!have_fitting_sizes(basis)) {
        throw Error(ErrorCode::invalid_argument,
                    "axes, nodes, weights and corrections of the keys do not fit the basis");
    }
    bool finite = keys.axes.allFinite() && keys.nodes.allFinite() && keys.blend.allFinite() &&
                  keys.min.allFinite() && keys.max.allFinite();
    for (const auto& offsets : keys.corrections) {
        for (const Vector3f& offset : offsets) finite = finite && offset.allFinite();
    }
    if (finite) return;
    throw Error(ErrorCode::not_finite,
                "corrections of key poses exceed the range of 32-bit numbers");
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
    require_consistent_keys(basis);
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
                      kHeaderBytes + block_bytes(h, n) + header.names == header.bytes;
    if (!fits) {
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

// ---- Key poses, behind the basis

// Key poses, nodes and axes.
struct KeySizes {
    std::uint64_t keys = 0, nodes = 0, axes = 0;

    std::uint64_t bytes(std::uint64_t handles, std::uint64_t vertices) const {
        const std::uint64_t doubles =
            axes * (kPoseNumbers * handles + 2 + nodes) + (nodes + axes + 1) * keys;
        return kKeysHeaderBytes + sizeof(double) * doubles + sizeof(Vector3f) * keys * vertices;
    }
};

std::size_t first_of_keys(std::size_t basis_bytes) {
    return (basis_bytes + kUnitBytes - 1) / kUnitBytes * kUnitBytes;
}

template <typename Matrix>
void add_rows(ByteWriter& writer, const Matrix& matrix) {
    for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
        for (Eigen::Index c = 0; c < matrix.cols(); ++c) writer.add(double{matrix(r, c)});
    }
}

void add_keys(ByteWriter& writer, const EngineBasis& basis) {
    const EngineKeys& keys = basis.keys;
    const KeySizes sizes{keys.corrections.size(), static_cast<std::uint64_t>(keys.nodes.rows()),
                         static_cast<std::uint64_t>(keys.axes.rows())};
    writer.add_text(kKeysMagic);
    for (const std::uint64_t size : {sizes.keys, sizes.nodes, sizes.axes, std::uint64_t{0}}) {
        writer.add(static_cast<std::uint32_t>(size));
    }
    writer.add(sizes.bytes(basis.handles.size(), basis.vertices.size()));
    add_rows(writer, keys.axes);
    add_rows(writer, keys.min);
    add_rows(writer, keys.max);
    add_rows(writer, keys.nodes);
    add_rows(writer, keys.blend);
    for (const auto& offsets : keys.corrections) {
        for (const Vector3f& offset : offsets) writer.add_vector(offset);
    }
}

template <typename Matrix>
void read_rows(ByteReader& reader, std::uint64_t rows, std::uint64_t columns, Matrix& matrix) {
    matrix.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
    for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
        for (Eigen::Index c = 0; c < matrix.cols(); ++c) matrix(r, c) = reader.read<double>();
    }
    if (!matrix.allFinite()) refuse(ErrorCode::not_finite, "a number of the keys is not finite");
}

KeySizes read_key_sizes(ByteReader& reader, const Header& header, std::size_t block_size) {
    KeySizes sizes;
    sizes.keys = reader.read<std::uint32_t>();
    sizes.nodes = reader.read<std::uint32_t>();
    sizes.axes = reader.read<std::uint32_t>();
    reader.skip(sizeof(std::uint32_t));
    const auto bytes = reader.read<std::uint64_t>();
    const bool plausible = sizes.keys > 0 && sizes.keys <= kMaxBasisKeys &&
                           sizes.nodes >= sizes.keys && sizes.nodes <= sizes.keys + 1 &&
                           sizes.axes <= sizes.keys &&
                           bytes == sizes.bytes(header.handles, header.vertices);
    if (!plausible) refuse_damaged("the sizes of the key poses do not fit the basis");
    if (bytes > block_size) {
        refuse_truncated({"bytes of the key poses", block_size, static_cast<std::size_t>(bytes)});
    }
    if (bytes < block_size) refuse_damaged("there are bytes behind the key poses");
    return sizes;
}

EngineKeys read_keys(std::string_view bytes, const Header& header) {
    if (bytes.size() < kKeysHeaderBytes || !bytes.starts_with(kKeysMagic)) {
        refuse_damaged("the sizes in the header do not fit the file");
    }
    ByteReader reader(bytes, Endianness::little);
    reader.tally = {"numbers of the key poses", 0, 0};
    reader.skip(kKeysMagic.size());
    const KeySizes sizes = read_key_sizes(reader, header, bytes.size());
    EngineKeys keys;
    read_rows(reader, sizes.axes, kPoseNumbers * header.handles, keys.axes);
    read_rows(reader, sizes.axes, 1, keys.min);
    read_rows(reader, sizes.axes, 1, keys.max);
    read_rows(reader, sizes.nodes, sizes.axes, keys.nodes);
    read_rows(reader, sizes.nodes + sizes.axes + 1, sizes.keys, keys.blend);
    keys.corrections.assign(static_cast<std::size_t>(sizes.keys),
                            std::vector<Vector3f>(header.vertices));
    for (auto& offsets : keys.corrections) {
        for (Vector3f& offset : offsets) offset = read_vector<Vector3f>(reader);
    }
    return keys;
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

// ---- Poses

Eigen::VectorXd pose_of(const EngineBasis& basis, std::span<const Affine> transforms) {
    Eigen::VectorXd pose(static_cast<Eigen::Index>(kPoseNumbers * transforms.size()));
    for (std::size_t h = 0; h < transforms.size(); ++h) {
        const Affine& t = transforms[h];
        const Vec3& o = basis.origin;
        const Affine local{t.linear, t.linear * o + (t.translation - o)};
        pose.segment<kPoseNumbers>(static_cast<Eigen::Index>(kPoseNumbers * h)) =
            engine_pose(local, basis.handles[h].center.cast<double>(), double{basis.size});
    }
    return pose;
}

Eigen::MatrixXd poses_of(const EngineBasis& basis, std::span<const BasisKey> keys) {
    Eigen::MatrixXd poses(static_cast<Eigen::Index>(kPoseNumbers * basis.handles.size()),
                          static_cast<Eigen::Index>(keys.size()));
    for (std::size_t k = 0; k < keys.size(); ++k) {
        poses.col(static_cast<Eigen::Index>(k)) = pose_of(basis, keys[k].transforms);
    }
    return poses;
}

void require_fitting(const EngineBasis& basis, std::span<const BasisKey> keys) {
    if (keys.size() > kMaxBasisKeys) {
        throw Error(
            ErrorCode::invalid_argument,
            "there are more than " + std::to_string(kMaxBasisKeys) + " key poses; take fewer");
    }
    for (const BasisKey& key : keys) {
        if (key.transforms.size() == basis.handles.size() &&
            key.positions.size() == basis.vertices.size()) {
            continue;
        }
        throw Error(ErrorCode::invalid_argument, "a key pose is not of the basis");
    }
}

// At rest the shape is that of the basis to the bit, unless the rest pose is a key.
void add_corrections(const EngineBasis& basis, std::span<const Affine> transforms,
                     std::vector<Vec3>& points) {
    const EngineKeys& keys = basis.keys;
    const bool has_rest = keys.nodes.rows() == static_cast<Eigen::Index>(keys.corrections.size());
    const bool rests = std::all_of(transforms.begin(), transforms.end(),
                                   [](const Affine& t) { return t.is_identity(); });
    if (keys.empty() || (rests && !has_rest)) return;
    const Eigen::VectorXd weights = keys.weights_at(pose_of(basis, transforms));
    for (std::size_t k = 0; k < keys.corrections.size(); ++k) {
        const double weight = weights[static_cast<Eigen::Index>(k)];
        for (std::size_t row = 0; row < points.size(); ++row) {
            points[row] += weight * keys.corrections[k][row].cast<double>();
        }
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
    add_corrections(*this, transforms, result);
    return result;
}

void set_keys(EngineBasis& basis, std::span<const BasisKey> keys) {
    require_fitting(basis, keys);
    basis.keys = {};
    if (keys.empty()) return;
    EngineKeys found = fit_engine_keys(poses_of(basis, keys));
    for (const BasisKey& key : keys) {
        const std::vector<Vec3> plain = basis.positions(key.transforms);
        std::vector<Vector3f>& offsets = found.corrections.emplace_back();
        for (std::size_t row = 0; row < plain.size(); ++row) {
            offsets.push_back((key.positions[row] - plain[row]).cast<float>());
        }
    }
    basis.keys = std::move(found);
    require_consistent_keys(basis);
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
    if (!basis.keys.empty()) {
        const auto size = static_cast<std::size_t>(bytes);
        writer.add_text(std::string(first_of_keys(size) - size, '\0'));
        add_keys(writer, basis);
    }
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
    const auto end = static_cast<std::size_t>(header.bytes);
    set_names(bytes.substr(end - header.names, header.names), names, basis.handles);
    if (end < bytes.size()) {
        basis.keys = read_keys(bytes.substr(std::min(first_of_keys(end), bytes.size())), header);
    }
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
