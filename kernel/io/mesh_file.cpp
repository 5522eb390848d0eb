#include "kernel/io/mesh_file.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/memory_error.h"
#include "kernel/io/gltf/gltf.h"
#include "kernel/io/obj/material_collector.h"
#include "kernel/io/obj/material_files.h"
#include "kernel/io/obj/obj.h"
#include "kernel/io/off/off.h"
#include "kernel/io/ply/ply.h"
#include "kernel/io/ply/textures.h"
#include "kernel/io/record/file_rules.h"
#include "kernel/io/record/float_loss.h"
#include "kernel/io/sniff.h"
#include "kernel/io/stl/stl.h"
#include "kernel/io/stream/file.h"
#include "kernel/io/stream/open_file.h"
#include "kernel/io/stream/scalar.h"
#include "kernel/mesh/measure/directions.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/repair/repair.h"

namespace lissom {
void log_findings(const Report& report, const Context& context) {
    for (const Finding& finding : report.findings()) {
        const bool is_quality = finding.kind >= FindingKind::faces_zero_area &&
                                finding.kind <= FindingKind::components_inverted;
        const bool is_flag = finding.kind == FindingKind::vertices_welded ||
                             finding.kind == FindingKind::points_only ||
                             (is_quality && finding.message.empty());
        std::string text = describe(finding);
        if (!finding.message.empty()) text += ": " + finding.message;
        context.log(is_flag ? LogLevel::info : LogLevel::warning, text);
    }
}

namespace {

struct Format {
    std::string_view extension, name;
    MeshData (*read)(const FileInput& file, const Context& context);
    void (*write)(SavedParts& parts, const SaveOptions& options, std::string& bytes,
                  const Context& context);
    // Whether it keeps the place of an object apart from its positions.
    bool has_places = false;
    // The files beside it that define materials, if it has such.
    MaterialFiles (*materials)(const Mesh& mesh, const std::filesystem::path& path,
                               const Context& context) = nullptr;
};

// A format that keeps all in one file.
template <MeshData (*Read)(std::string_view, const Context&)>
MeshData read_alone(const FileInput& file, const Context& context) {
    return Read(file.bytes, context);
}

// OBJ refers to files of materials.
MeshData read_obj_file(const FileInput& file, const Context& context) {
    MeshData data = read_obj(file.bytes, context);
    read_material_libraries(file, data, context);
    return data;
}

// PLY refers to pictures.
MeshData read_ply_file(const FileInput& file, const Context& context) {
    MeshData data = read_ply(file.bytes, context);
    read_ply_textures(file, data, context);
    return data;
}

constexpr std::array<Format, 6> kFormats{
    {{"obj", "OBJ", read_obj_file, write_obj, false, material_files},
     {"ply", "PLY", read_ply_file, write_ply},
     {"off", "OFF", read_alone<read_off>, write_off},
     {"stl", "STL", read_alone<read_stl>, write_stl},
     {"gltf", "glTF", read_gltf, write_gltf, true},
     {"glb", "glTF", read_gltf, write_glb, true}}};

const Format& find_format(std::string_view extension) {
    const std::string wanted = normalized_extension(extension);
    std::string known;
    for (const Format& format : kFormats) {
        if (format.extension == wanted) return format;
        known += (known.empty() ? "" : ", ") + std::string(format.extension);
    }
    throw Error(
        ErrorCode::unknown_format,
        (wanted.empty() ? "there is no extension" : "the extension '" + wanted + "' is unknown") +
            std::string("; known are ") + known);
}

void require_expected_content(std::string_view bytes, const Format& format) {
    const std::string_view found = sniff_format(bytes);
    if (found.empty() || found == format.name) return;
    throw Error(ErrorCode::file_syntax, "the extension says " + std::string(format.name) +
                                            ", but the content looks like " + std::string(found) +
                                            "; rename the file");
}

void require_compressible(const Format& format, const SaveOptions& options) {
    constexpr int kMinBits = 6, kMaxBits = 20;
    const bool is_compressed = options.compression != Compression::none;
    if (is_compressed && format.name != "glTF") {
        throw Error(ErrorCode::invalid_argument,
                    "compression is of glTF files (.glb, .gltf), and " + std::string(format.name) +
                        " has none");
    }
    if (options.quantize == 0) return;
    if (format.name != "glTF") {
        throw Error(ErrorCode::invalid_argument,
                    "numbers are quantised in glTF files (.glb, .gltf) only, and not in " +
                        std::string(format.name));
    }
    if (options.quantize >= kMinBits && options.quantize <= kMaxBits) return;
    throw Error(ErrorCode::invalid_argument, std::to_string(options.quantize) +
                                                 " bits cannot be kept; choose 6 to 20, or 0 for "
                                                 "all");
}

// The linear map from a file's axes and unit to the kernel's.
Mat3 from_file(UpAxis up, double unit) {
    Mat3 turned = Mat3::Identity();
    if (up == UpAxis::z) turned << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    return unit * turned;
}

bool is_kernel_frame(UpAxis up, double unit) {
    return up != UpAxis::z && unit == 1.0;
}

void apply(const LoadOptions& options, MeshData& data) {
    if (is_kernel_frame(options.up, options.unit)) return;
    const Mat3 map = from_file(options.up, options.unit);
    for (Vec3& p : data.positions) p = map * p;
    map_directions(data.attributes, map);
}

// The mesh in the file's axes and unit around `origin`, or nothing if they are the kernel's own.
std::optional<Mesh> in_file_frame(const Mesh& mesh, const SaveOptions& options,
                                  const Vec3& origin) {
    const bool is_turned = !is_kernel_frame(options.up, options.unit);
    if (!is_turned && origin.isZero(0.0)) return std::nullopt;
    const Mat3 turn = from_file(options.up, 1.0).transpose();
    Mesh result = mesh;
    std::vector<Vec3> positions(mesh.positions().begin(), mesh.positions().end());
    for (Vec3& p : positions) p -= origin;
    if (is_turned) {
        for (Vec3& p : positions) p = turn * (p / options.unit);
        map_directions(result.attributes(), turn / options.unit);
    }
    result.set_positions(std::move(positions));
    return result;
}

// The mesh with the normals of its surface as an attribute, or nothing if none are asked for. A
// vertex that has none gets no value.
std::optional<Mesh> with_normals(const Mesh& mesh, const Format& format,
                                 const SaveOptions& options) {
    const bool wanted = options.normals && format.name != "STL";
    if (!wanted || mesh.face_count() == 0 || mesh.attributes().find("normal")) return std::nullopt;
    Attribute normals{"normal", Domain::vertex, 3, ScalarType::float32, {}};
    for (const Vec3& normal : vertex_normals(mesh)) {
        const bool has_none = normal.isZero(0.0);
        for (const double x : normal) normals.values.push_back(has_none ? kNone : x);
    }
    Mesh result = mesh;
    result.attributes().add(std::move(normals));
    return result;
}

// The origin of a file whose format has no other place for it.
Vec3 moved_origin(const Mesh& mesh, const Format& format, const SaveOptions& options) {
    if (options.origin == FileOrigin::keep || format.has_places) return Vec3::Zero();
    return near_origin(bounds(mesh));
}

void tell_origin(const Vec3& origin, const Format& format, const Context& context) {
    if (origin.isZero(0.0)) return;
    // As many digits as 32-bit numbers need.
    char place[64];
    std::snprintf(place, sizeof place, "(%.9g, %.9g, %.9g)", origin.x(), origin.y(), origin.z());
    context.log(LogLevel::warning, "the origin of the file is the point " + std::string(place) +
                                       " of the mesh, which " + std::string(format.name) +
                                       " cannot hold; add it to the points that are read");
}

// Values that were written out in decimals, flipped or turned need more than a float.
void widen_type(Attribute& attribute) {
    const auto& values = attribute.values;
    const bool fits = attribute.type != ScalarType::float32 ||
                      std::all_of(values.begin(), values.end(),
                                  [](double x) { return std::isnan(x) || is_float(x); });
    if (!fits) attribute.type = ScalarType::float64;
}

RepairOptions repair_options(const LoadOptions& options, const MeshData& data) {
    const Weld usual = data.faces_are_separate ? Weld::all
                       : data.seams_are_known  ? Weld::none
                                               : Weld::seams;
    return {options.weld.value_or(usual), options.repair, options.unused};
}

Mesh decode(FileInput file, const Format& format, const LoadOptions& options,
            const Context& context) {
    require_unit(options.unit);
    file.bytes = without_byte_order_mark(file.bytes);
    Progress progress(context, "load mesh");
    progress.step(0.6);
    require_expected_content(file.bytes, format);
    MeshData data = format.read(file, context);
    const MemoryCharge charge = context.charge(data.memory_bytes(), "the mesh of a file");
    apply(options, data);
    for (Attribute& attribute : data.attributes.all()) widen_type(attribute);
    if (data.positions.empty()) context.log(LogLevel::warning, "the file has no vertices");

    progress.step(0.4);
    const RepairOptions repair_with = repair_options(options, data);
    Mesh mesh =
        repair(std::move(static_cast<Soup&>(data)), repair_with, context, std::move(data.report));
    mesh.material_libraries() = std::move(data.material_libraries);
    mesh.set_asset(std::move(data.asset));
    log_findings(mesh.report(), context);
    return mesh;
}

struct Encoded {
    std::string bytes;
    SavedFile saved;
    // Written before the file.
    std::vector<SideFile> beside;
};

// `path` is empty for a file in memory, which has no others beside it.
Encoded encode(const Mesh& given, const Format& format, const SaveOptions& options,
               const std::filesystem::path& path, const Context& context) {
    require_unit(options.unit);
    require_compressible(format, options);
    // The size of the file is not known yet, but of the order of the mesh's.
    const MemoryCharge charge = context.charge(given.memory_bytes(), "saving a mesh");
    const std::optional<Mesh> lit = with_normals(given, format, options);
    const Mesh& mesh = lit ? *lit : given;
    Encoded result;
    result.saved.origin = moved_origin(mesh, format, options);
    const std::optional<Mesh> turned = in_file_frame(mesh, options, result.saved.origin);
    SavedParts parts(turned ? *turned : mesh);
    if (format.materials && !path.empty()) {
        MaterialFiles materials = format.materials(mesh, path, context);
        parts.replace_material_libraries(std::move(materials.libraries), materials.holds_asset);
        result.beside = std::move(materials.files);
    }
    format.write(parts, options, result.bytes, context);
    parts.log_losses(format.name, context);
    tell_origin(result.saved.origin, format, context);
    return result;
}

// Writes files one after the other; without commit() they are then as they were.
class FileGroup {
  public:
    explicit FileGroup(const Context& context) : context_(context) {}
    FileGroup(const FileGroup&) = delete;
    FileGroup& operator=(const FileGroup&) = delete;
    ~FileGroup() {
        for (auto file = written_.rbegin(); file != written_.rend(); ++file) restore(*file);
    }

    void write(const std::filesystem::path& path, std::string_view bytes) {
        Old old{path, content_of(path)};
        write_file_atomically(path, bytes, context_);
        written_.push_back(std::move(old));
    }
    void commit() { written_.clear(); }

  private:
    struct Old {
        std::filesystem::path path;
        std::optional<std::string> bytes;
    };

    std::optional<std::string> content_of(const std::filesystem::path& path) const {
        try {
            return read_file(path, context_).bytes;
        } catch (const Error& error) {
            if (error.code() == ErrorCode::file_empty) return std::string();
            if (error.code() != ErrorCode::file_not_found) throw;
            return std::nullopt;
        }
    }

    // Best effort, for an error is under way.
    void restore(const Old& old) const noexcept try {
        std::error_code ignored;
        if (old.bytes) {
            write_file_atomically(old.path, *old.bytes, Context());
        } else {
            std::filesystem::remove(old.path, ignored);
        }
    } catch (...) {
    }

    const Context& context_;
    std::vector<Old> written_;
};

// Throws if a link stands in the place of a file beside the mesh's and leads out of its folder.
void require_beside(const std::filesystem::path& file, const std::filesystem::path& mesh,
                    const Context& context) {
    if (context.files().write) return;
    const std::filesystem::path folder = mesh.parent_path();
    path_within(folder.empty() ? "." : folder, file.lexically_proximate(folder));
}

std::vector<std::string> extensions() {
    std::vector<std::string> list;
    for (const Format& format : kFormats) list.emplace_back(format.extension);
    return list;
}

}  // namespace

Mesh load_mesh(const std::filesystem::path& path, const LoadOptions& options,
               const Context& context) {
    require_file(path, context);
    const std::string name = display_name(path);
    const Format& format = with_place_in_errors(
        name, [&]() -> const Format& { return find_format(display_name(path.extension())); });
    const FileContent file = read_file(path, context);
    const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    return with_place_in_errors(name, [&] {
        return with_memory_errors([&] {
            return decode({file.bytes, folder}, format, options, context);
        });
    });
}

SavedFile save_mesh(const Mesh& mesh, const std::filesystem::path& path, const SaveOptions& options,
                    const Context& context) {
    require_folder_of(path, context);
    Progress progress(context, "save mesh");
    progress.step(0.8);
    const Encoded encoded = with_place_in_errors(display_name(path), [&] {
        return with_memory_errors([&] {
            return encode(mesh, find_format(display_name(path.extension())), options, path,
                          context);
        });
    });
    progress.step(0.2);
    FileGroup beside(context);
    for (const SideFile& file : encoded.beside) {
        require_beside(file.path, path, context);
        beside.write(file.path, file.bytes);
    }
    write_file_atomically(path, encoded.bytes, context);
    beside.commit();
    return encoded.saved;
}

Mesh decode_mesh(std::string_view bytes, std::string_view extension, const LoadOptions& options,
                 const Context& context) {
    const Format& format = find_format(extension);
    if (bytes.empty()) throw Error(ErrorCode::file_empty, "the file has no bytes");
    return with_place_in_errors("", [&] {
        return with_memory_errors([&] { return decode({bytes, {}}, format, options, context); });
    });
}

std::string encode_mesh(const Mesh& mesh, std::string_view extension, const SaveOptions& options,
                        const Context& context) {
    return with_memory_errors(
        [&] { return encode(mesh, find_format(extension), options, {}, context).bytes; });
}

const std::vector<std::string>& readable_extensions() {
    static const std::vector<std::string> list = extensions();
    return list;
}

const std::vector<std::string>& writable_extensions() {
    static const std::vector<std::string> list = extensions();
    return list;
}

}  // namespace lissom
