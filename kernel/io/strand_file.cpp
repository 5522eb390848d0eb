#include "kernel/io/strand_file.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/memory_error.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_place.h"
#include "kernel/io/gltf/strands.h"
#include "kernel/io/hair/cyhair.h"
#include "kernel/io/hair/hair_salon.h"
#include "kernel/io/hair/rib_curves.h"
#include "kernel/io/hair/rib_scene.h"
#include "kernel/io/hair/tressfx.h"
#include "kernel/io/obj/strands.h"
#include "kernel/io/ply/strands.h"
#include "kernel/io/record/file_hair.h"
#include "kernel/io/record/file_rules.h"
#include "kernel/io/record/strand_check.h"
#include "kernel/io/stream/byte_source.h"
#include "kernel/io/stream/file.h"
#include "kernel/io/usda/curves.h"

namespace lissom {
namespace {

// A format: its reader, of a source or of all bytes, if any, its writer, and its limits.
struct StrandFormat {
    std::string_view extension;
    Strands (*read)(ByteSource& source, const Context& context);
    FileHair (*read_whole)(std::string_view bytes, const Context& context);
    void (*write)(const Strands& strands, const StrandSaveOptions& options, const RibScene& scene,
                  std::string& bytes, const Context& context);
    StrandCapacity capacity;

    bool readable() const { return read || read_whole; }
};

void write_hair_file(const Strands& strands, const StrandSaveOptions&, const RibScene&,
                     std::string& bytes, const Context&) {
    write_cyhair(strands, bytes);
}
void write_data_file(const Strands& strands, const StrandSaveOptions&, const RibScene&,
                     std::string& bytes, const Context&) {
    write_hair_salon(strands, bytes);
}
// Metres of the strands to those of the file.
Affine frame_of_file(const StrandSaveOptions& options) {
    Mat3 turn = Mat3::Identity();
    if (options.up == UpAxis::z) turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    return {turn / options.unit, Vec3::Zero()};
}
// The joints at the roots, in the frame of the file. `unit` is that of the head in metres.
StrandSkin skin_in_file(const Strands& strands, const StrandSaveOptions& options, double unit,
                        const Context& context) {
    const Affine frame = frame_of_file(options);
    StrandSkin skin = skin_at_roots(strands, *options.head, unit / options.unit, context);
    const Mat3 turn = frame.linear * options.unit;
    for (auto* transforms : {&skin.skeleton.bind, &skin.skeleton.rest}) {
        for (Affine& map : *transforms) {
            map = {turn * map.linear * turn.transpose(), turn * map.translation};
        }
    }
    return skin;
}
void write_usda_file(const Strands& strands, const StrandSaveOptions& options,
                     const RibScene& scene, std::string& bytes, const Context& context) {
    std::optional<StrandSkin> skin;
    if (options.head) skin = skin_in_file(strands, options, scene.unit.value_or(1.0), context);
    write_usda(strands, options.unit, options.up, skin ? &*skin : nullptr, bytes, context);
}

// `strands` are in the frame of the file.
void write_rib_file(const Strands& strands, const StrandSaveOptions& options, const RibScene& scene,
                    std::string& bytes, const Context& context) {
    bytes = "##RenderMan RIB-Structure 1.1\nversion 3.04\n";
    if (scene.archive) return write_rib_curves(strands, bytes, context);
    const Affine frame = frame_of_file(options);
    const Box box = bounds(strands);
    Box hair;
    if (!box.empty()) {
        const Mat3 back = frame.linear.inverse();
        hair.extend(back * box.min);
        hair.extend(back * box.max);
    }
    const RibSceneWriter writer(scene, hair, frame, context);
    writer.begin(bytes);
    write_rib_curves(strands, bytes, context);
    RibSceneWriter::end(bytes);
}
template <void (*Write)(const Strands&, std::string&, const Context&)>
void write_plainly(const Strands& strands, const StrandSaveOptions&, const RibScene&,
                   std::string& bytes, const Context& context) {
    Write(strands, bytes, context);
}

constexpr StrandCapacity kCyHair{.widths = true, .colors = true, .transparency = true};
// A strand of one point says that there is no hair.
constexpr StrandCapacity kHairSalon{.min_points = 1};
constexpr StrandCapacity kUsda{.widths = true,
                               .colors = true,
                               .transparency = true,
                               .root_uvs = true,
                               .groups = true,
                               .origins = true};
constexpr StrandCapacity kPly = kUsda;
// Transparency is the alpha of colours.
constexpr StrandCapacity kTressFx{.widths = true,
                                  .widths_along = false,
                                  .colors = true,
                                  .transparency = true,
                                  .transparency_with_colors = true,
                                  .root_uvs = true,
                                  .point_count = tressfx_points};
constexpr StrandCapacity kRib{.widths = true, .colors = true, .groups = true};
constexpr StrandCapacity kGltf = kUsda;
constexpr StrandCapacity kObj{.groups = true};

constexpr std::array<StrandFormat, 9> kStrandFormats{{
    {"hair", read_cyhair, nullptr, write_hair_file, kCyHair},
    {"data", read_hair_salon, nullptr, write_data_file, kHairSalon},
    {"usda", nullptr, read_usda, write_usda_file, kUsda},
    {"tfx", nullptr, read_tressfx, write_plainly<write_tressfx>, kTressFx},
    {"ply", nullptr, read_ply_strands, write_plainly<write_ply_strands>, kPly},
    {"rib", nullptr, nullptr, write_rib_file, kRib},
    {"glb", nullptr, read_gltf_strands, write_plainly<write_glb_strands>, kGltf},
    {"gltf", nullptr, read_gltf_strands, write_plainly<write_gltf_strands>, kGltf},
    {"obj", nullptr, nullptr, write_plainly<write_obj_strands>, kObj},
}};

std::vector<std::string> strand_extensions(bool for_reading) {
    std::vector<std::string> list;
    for (const StrandFormat& format : kStrandFormats) {
        if (!for_reading || format.readable()) list.emplace_back(format.extension);
    }
    return list;
}

const StrandFormat& find_strand_format(std::string_view extension, bool for_reading) {
    const std::string wanted = normalized_extension(extension);
    for (const StrandFormat& format : kStrandFormats) {
        if (format.extension == wanted && (!for_reading || format.readable())) return format;
    }
    std::string known;
    for (const std::string& name : strand_extensions(for_reading)) {
        known += (known.empty() ? "" : ", ") + name;
    }
    throw Error(ErrorCode::unknown_format,
                (wanted.empty() ? "there is no extension"
                                : "hair cannot be " +
                                      std::string(for_reading ? "read from '." : "written to '.") +
                                      wanted + "' files") +
                    std::string("; known are ") + known);
}

void require_scene(const RibScene& scene, std::string_view extension) {
    if (normalized_extension(extension) != "rib") {
        throw Error(ErrorCode::invalid_argument,
                    "a scene with a head, a camera, or an archive is for .rib files, not for ." +
                        normalized_extension(extension));
    }
    if (!scene.archive || (!scene.head && !scene.camera)) return;
    throw Error(ErrorCode::invalid_argument,
                "an archive holds hair alone; leave out 'archive', or the head and the camera");
}

// Puts points and widths into another frame: those of a z-up file into the kernel's if `up` is 1,
// the other way if it is -1, unchanged if it is 0.
void change_frame(Strands& strands, int up, double scale, const Context& context) {
    if (up == 0 && scale == 1.0) return;
    context.parallel_for(0, strands.size(), 256, [&](Index begin, Index end) {
        for (Index s = begin; s < end; ++s) {
            StrandEdit strand = strands.edit_strand(s);
            if (scale != 1.0) {
                strand = (strand.cast<double>() * scale).cast<float>().eval();
            }
            if (up == 0) continue;
            strand.row(1).swap(strand.row(2));
            strand.row(up > 0 ? 2 : 1) *= -1.0f;
        }
    });
    if (scale == 1.0) return;
    StrandWidths widths = strands.widths();
    widths.common = widths.common * scale;
    for (float& width : widths.values) width = static_cast<float>(width * scale);
    strands.set_widths(std::move(widths));
}

void require_range(const Strands& strands) {
    require_finite(strands.points(), 3, 0, strands.offsets());
    for (const float width : strands.widths().values) {
        if (std::isfinite(width)) continue;
        throw Error(ErrorCode::not_finite, "widths exceed the range of 32-bit numbers");
    }
}

Strands in_kernel_frame(FileHair hair, const StrandLoadOptions& options, const Context& context) {
    const UpAxis up = options.up == UpAxis::none ? hair.up : options.up;
    const double unit = options.unit.value_or(hair.meters_per_unit.value_or(1.0));
    // If the file says nothing of widths, they are in metres as they are.
    const StrandWidths usual = hair.strands.widths();
    change_frame(hair.strands, up == UpAxis::z ? 1 : 0, unit, context);
    if (!hair.has_widths) hair.strands.set_widths(usual);
    if (unit != 1.0) require_range(hair.strands);
    return std::move(hair.strands);
}

Strands decode_as(ByteSource* source, std::string_view text, const StrandFormat& format,
                  const StrandLoadOptions& options, const Context& context) {
    if (options.unit) require_unit(*options.unit);
    Progress progress(context, "load strands");
    progress.step(0.9);
    FileHair hair;
    if (source) {
        hair.strands = format.read(*source, context);
        hair.has_widths = format.capacity.widths;
    } else {
        // Numbers in memory are not much longer than those of a file, but lists grow by doubling.
        const MemoryCharge charge = context.charge(4 * text.size(), "reading strands");
        hair = format.read_whole(without_byte_order_mark(text), context);
    }
    progress.step(0.1);
    return in_kernel_frame(std::move(hair), options, context);
}

EncodedStrands encode_as(const Strands& strands, const StrandFormat& format,
                         const StrandSaveOptions& options, const RibScene& scene,
                         const Context& context) {
    require_unit(options.unit);
    if (options.head && format.extension != "usda") {
        throw Error(ErrorCode::invalid_argument,
                    "a head whose joints move the hair is for .usda files, not for ." +
                        std::string(format.extension));
    }
    Progress progress(context, "save strands");
    progress.step(0.3);
    // Upper bound for the text of numbers, in a list that grows by doubling.
    const MemoryCharge charge = context.charge(10 * strands.memory_bytes(), "saving strands");
    CheckedStrands checked = check_strands(strands, format.capacity, options, context);
    progress.step(0.7);
    if (options.up == UpAxis::z || options.unit != 1.0) {
        if (!checked.changed) checked.changed = strands;
        change_frame(*checked.changed, options.up == UpAxis::z ? -1 : 0, 1.0 / options.unit,
                     context);
        require_range(*checked.changed);
    }
    EncodedStrands result;
    RibScene known = scene;
    const Mesh* const head = options.head ? options.head : scene.head;
    if (head && !scene.unit) known.unit = unit_of_roots(strands, *head);
    format.write(checked.changed ? *checked.changed : strands, options, known, result.bytes,
                 context);
    result.report = std::move(checked.report);
    for (const StrandFinding& finding : result.report.findings) {
        context.log(LogLevel::warning, finding.message);
    }
    return result;
}

// The picture that a renderer makes of a .rib file.
std::string picture_beside(const std::filesystem::path& path) {
    return display_name(path.stem()) + ".tif";
}

}  // namespace

namespace {

// Extents of a head of hair in metres, from stubble to hair to the floor.
constexpr double kSmallestHair = 0.02, kLargestHair = 3.0;

// Files whose unit is not the metre, and is not told, give hair of the wrong size.
void tell_odd_size(const std::string& name, const Strands& strands,
                   const StrandLoadOptions& options, const Context& context) {
    if (options.unit || strands.empty()) return;
    const double extent = bounds(strands).diagonal();
    if (extent == 0.0 || (extent >= kSmallestHair && extent <= kLargestHair)) return;
    std::ostringstream message;
    message.precision(3);
    message << name << ": the unit of the hair is not known: in metres it is " << extent
            << " large; the option `unit`, metres for one unit of the file, says otherwise";
    context.log(LogLevel::warning, message.str());
}

Strands read_strands(const std::filesystem::path& path, const StrandLoadOptions& options,
                     const Context& context) {
    require_file(path, context);
    const std::string name = display_name(path);
    const StrandFormat& format = with_place_in_errors(name, [&]() -> const StrandFormat& {
        return find_strand_format(display_name(path.extension()), true);
    });
    if (!format.read || context.files().read) {
        const FileContent file = read_file(path, context);
        return with_place_in_errors(name, [&] {
            ByteSource source(std::string_view(file.bytes));
            return decode_as(format.read ? &source : nullptr, file.bytes, format, options, context);
        });
    }
    return with_place_in_errors(name, [&] {
        ByteSource source(path);
        return decode_as(&source, {}, format, options, context);
    });
}

}  // namespace

Strands load_strands(const std::filesystem::path& path, const StrandLoadOptions& options,
                     const Context& context) try {
    Strands strands = read_strands(path, options, context);
    tell_odd_size(display_name(path), strands, options, context);
    return strands;
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

StrandReport save_strands(const Strands& strands, const std::filesystem::path& path,
                          const StrandSaveOptions& options, const Context& context) try {
    require_folder_of(path, context);
    Progress progress(context, "save strands");
    progress.step(0.8);
    EncodedStrands encoded = with_place_in_errors(display_name(path), [&] {
        return encode_as(strands, find_strand_format(display_name(path.extension()), false),
                         options, {.picture = picture_beside(path)}, context);
    });
    progress.step(0.2);
    write_file_atomically(path, encoded.bytes, context);
    return std::move(encoded.report);
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

StrandReport save_rib(const Strands& strands, const std::filesystem::path& path,
                      const RibScene& scene, const StrandSaveOptions& options,
                      const Context& context) try {
    require_folder_of(path, context);
    Progress progress(context, "save strands");
    progress.step(0.8);
    EncodedStrands encoded = with_place_in_errors(display_name(path), [&] {
        require_scene(scene, display_name(path.extension()));
        RibScene named = scene;
        if (named.picture.empty()) named.picture = picture_beside(path);
        return encode_rib(strands, named, options, context);
    });
    progress.step(0.2);
    write_file_atomically(path, encoded.bytes, context);
    return std::move(encoded.report);
} catch (const std::bad_alloc&) {
    throw_out_of_memory();
}

Strands decode_strands(std::string_view bytes, std::string_view extension,
                       const StrandLoadOptions& options, const Context& context) {
    const StrandFormat& format = find_strand_format(extension, true);
    return with_place_in_errors("", [&] {
        ByteSource source(bytes);
        return decode_as(format.read ? &source : nullptr, bytes, format, options, context);
    });
}

EncodedStrands encode_strands(const Strands& strands, std::string_view extension,
                              const StrandSaveOptions& options, const Context& context) {
    return encode_as(strands, find_strand_format(extension, false), options, {}, context);
}

EncodedStrands encode_rib(const Strands& strands, const RibScene& scene,
                          const StrandSaveOptions& options, const Context& context) {
    require_scene(scene, "rib");
    return encode_as(strands, find_strand_format("rib", false), options, scene, context);
}

const std::vector<std::string>& readable_strand_extensions() {
    static const std::vector<std::string> list = strand_extensions(true);
    return list;
}

const std::vector<std::string>& writable_strand_extensions() {
    static const std::vector<std::string> list = strand_extensions(false);
    return list;
}

}  // namespace lissom
