#include "kernel/io/gltf/file/draco.h"

#include <algorithm>
#include <memory>

#include "kernel/core/error.h"
#include "kernel/io/stream/read_error.h"
#include "kernel/io/stream/scalar.h"

#ifdef LISSOM_HAS_DRACO
#include <draco/compression/config/compression_shared.h>
#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <draco/compression/point_cloud/point_cloud_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>
#include <draco/metadata/metadata_decoder.h>
#endif

namespace lissom {

#ifdef LISSOM_HAS_DRACO
namespace {

constexpr std::size_t kMaxFacesPerByte = 64, kFacesAlwaysAllowed = 65536;
constexpr int kOldestMajor = 2, kOldestMinor = 2;

[[noreturn]] void refuse_draco(const std::string& why) {
    refuse(ErrorCode::file_syntax, "a primitive compressed by Draco is corrupt: " + why);
}

draco::DecoderBuffer buffer_of(std::string_view bytes) {
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    return buffer;
}

std::uint32_t read_count(draco::DecoderBuffer& buffer) {
    std::uint32_t count = 0;
    if (!draco::DecodeVarint(&count, &buffer)) refuse_draco("its header ends too early");
    return count;
}

// Reads the header, so that nothing is allocated for more elements than the bytes can hold.
void require_plausible_size(std::string_view bytes) {
    draco::DecoderBuffer buffer = buffer_of(bytes);
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&buffer, &header).ok()) refuse_draco("no header");
    if (header.encoder_type != draco::TRIANGULAR_MESH) {
        refuse(ErrorCode::unsupported, "a primitive compressed by Draco is no mesh of triangles");
    }
    if (header.version_major != kOldestMajor || header.version_minor < kOldestMinor) {
        refuse(ErrorCode::unsupported, "a primitive is compressed by Draco's format " +
                                           std::to_string(header.version_major) + "." +
                                           std::to_string(header.version_minor) +
                                           ", but glTF has 2.2");
    }
    buffer.set_bitstream_version(
        DRACO_BITSTREAM_VERSION(header.version_major, header.version_minor));
    if (header.flags & METADATA_FLAG_MASK) {
        draco::GeometryMetadata metadata;
        if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata)) {
            refuse_draco("its metadata cannot be read");
        }
    }
    std::uint8_t traversal = 0;
    const bool is_edgebreaker = header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING;
    if (is_edgebreaker && !buffer.Decode(&traversal)) refuse_draco("its header ends too early");
    // Faces and vertices in one order or the other.
    const std::size_t largest = std::max(read_count(buffer), read_count(buffer));
    if (largest <= kMaxFacesPerByte * bytes.size() + kFacesAlwaysAllowed) return;
    refuse(ErrorCode::file_too_large, "a compressed primitive of " + std::to_string(bytes.size()) +
                                          " bytes cannot have " + std::to_string(largest) +
                                          " elements");
}

template <typename T>
std::string numbers_of(const draco::PointAttribute& attribute, std::size_t count, Index width) {
    std::string bytes;
    bytes.reserve(count * width * sizeof(T));
    std::vector<T> row(width);
    for (std::size_t i = 0; i < count; ++i) {
        const draco::PointIndex point(static_cast<std::uint32_t>(i));
        const draco::AttributeValueIndex value = attribute.mapped_index(point);
        const bool good =
            value.value() < attribute.size() &&
            attribute.ConvertValue<T>(value, static_cast<std::int8_t>(width), row.data());
        if (!good) refuse_draco("values of an attribute do not fit their accessor");
        for (const T x : row) append_number(bytes, x, Endianness::little);
    }
    return bytes;
}

std::string attribute_bytes(const draco::Mesh& mesh, const DracoWanted& wanted) {
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(wanted.id);
    if (!attribute) refuse_draco("it has no attribute " + std::to_string(wanted.id));
    std::string bytes;
    with_scalar(wanted.type, [&](auto zero) {
        bytes = numbers_of<decltype(zero)>(*attribute, mesh.num_points(), wanted.width);
    });
    return bytes;
}

std::unique_ptr<draco::Mesh> decoded_mesh(std::string_view bytes) {
    draco::DecoderBuffer buffer = buffer_of(bytes);
    auto result = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    if (!result.ok()) refuse_draco(result.status().error_msg_string());
    return std::move(result).value();
}

draco::DataType data_type(ScalarType type) {
    switch (type) {
        case ScalarType::int8:
            return draco::DT_INT8;
        case ScalarType::uint8:
            return draco::DT_UINT8;
        case ScalarType::int16:
            return draco::DT_INT16;
        case ScalarType::uint16:
            return draco::DT_UINT16;
        case ScalarType::uint32:
            return draco::DT_UINT32;
        default:
            return draco::DT_FLOAT32;
    }
}

int add_attribute(draco::Mesh& mesh, const DracoAttribute& attribute, std::size_t count) {
    const std::size_t stride = attribute.width * size_of(attribute.type);
    draco::GeometryAttribute description;
    description.Init(attribute.is_position ? draco::GeometryAttribute::POSITION
                                           : draco::GeometryAttribute::GENERIC,
                     nullptr, static_cast<std::int8_t>(attribute.width), data_type(attribute.type),
                     attribute.normalized, static_cast<std::int64_t>(stride), 0);
    const auto values = static_cast<std::uint32_t>(count);
    const int id = mesh.AddAttribute(description, true, values);
    for (std::uint32_t i = 0; i < values; ++i) {
        mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i),
                                              attribute.bytes.data() + i * stride);
    }
    return id;
}

void quantize(draco::ExpertEncoder& encoder, int id, const DracoAttribute& attribute) {
    if (attribute.least.empty() || attribute.range <= 0.0f) {
        encoder.SetAttributeQuantization(id, attribute.bits);
    } else {
        encoder.SetAttributeExplicitQuantization(id, attribute.bits,
                                                 static_cast<int>(attribute.width),
                                                 attribute.least.data(), attribute.range);
    }
}

void add_triangles(draco::Mesh& mesh, const std::vector<std::uint32_t>& indices) {
    mesh.SetNumFaces(indices.size() / 3);
    for (std::size_t f = 0; f < indices.size() / 3; ++f) {
        mesh.SetFace(draco::FaceIndex(static_cast<std::uint32_t>(f)),
                     {draco::PointIndex(indices[3 * f]), draco::PointIndex(indices[3 * f + 1]),
                      draco::PointIndex(indices[3 * f + 2])});
    }
}

}  // namespace

bool has_draco() {
    return true;
}

DracoPrimitive decode_draco(std::string_view bytes, const std::vector<DracoWanted>& wanted) {
    require_plausible_size(bytes);
    const std::unique_ptr<draco::Mesh> mesh = decoded_mesh(bytes);
    DracoPrimitive result;
    result.vertex_count = mesh->num_points();
    result.indices.reserve(3 * std::size_t{mesh->num_faces()});
    for (std::uint32_t f = 0; f < mesh->num_faces(); ++f) {
        for (const draco::PointIndex& point : mesh->face(draco::FaceIndex(f))) {
            result.indices.push_back(point.value());
        }
    }
    for (const DracoWanted& one : wanted) {
        result.attributes.push_back(attribute_bytes(*mesh, one));
    }
    return result;
}

std::string encode_draco(const std::vector<std::uint32_t>& indices,
                         const std::vector<DracoAttribute>& attributes) {
    draco::Mesh mesh;
    const DracoAttribute& first = attributes.front();
    const std::size_t count = first.bytes.size() / (first.width * size_of(first.type));
    mesh.set_num_points(static_cast<std::uint32_t>(count));
    add_triangles(mesh, indices);
    for (const DracoAttribute& attribute : attributes) add_attribute(mesh, attribute, count);
    draco::ExpertEncoder encoder(mesh);
    encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
    encoder.SetSpeedOptions(0, 0);
    for (std::size_t a = 0; a < attributes.size(); ++a) {
        const bool is_float = attributes[a].type == ScalarType::float32;
        if (attributes[a].bits == 0 || !is_float) continue;
        quantize(encoder, static_cast<int>(a), attributes[a]);
    }
    draco::EncoderBuffer buffer;
    const draco::Status status = encoder.EncodeToBuffer(&buffer);
    if (status.ok()) return {buffer.data(), buffer.size()};
    throw Error(ErrorCode::unsupported,
                "Draco cannot compress the mesh: " + status.error_msg_string());
}

#else

namespace {

[[noreturn]] void refuse_without_draco() {
    refuse(ErrorCode::unsupported,
           "KHR_draco_mesh_compression is not part of this build; build it with Draco (on Debian: "
           "apt-get install libdraco-dev)");
}

}  // namespace

bool has_draco() {
    return false;
}

DracoPrimitive decode_draco(std::string_view, const std::vector<DracoWanted>&) {
    refuse_without_draco();
}

std::string encode_draco(const std::vector<std::uint32_t>&, const std::vector<DracoAttribute>&) {
    refuse_without_draco();
}

#endif

}  // namespace lissom
