#include "kernel/io/part_file.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "kernel/io/mesh_file.h"
#include "kernel/io/stream/file.h"
#include "kernel/mesh/edit/extract.h"
#include "kernel/mesh/edit/transform.h"

namespace lissom {
namespace {

constexpr const char* kRegionName = "region";
constexpr const char* kFeatureName = "feature";
constexpr Index kRingsAround = 3;
constexpr double kNoLength = 1e-12;

void require_part_format(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    if (extension == ".glb" || extension == ".gltf") return;
    throw Error(ErrorCode::unsupported,
                "parts are kept in .glb and .gltf files, which hold "
                "regions; give the file one of these extensions");
}

// Turns the frame upright.
Mat3 upright(const PartFrame& frame) {
    const Vec3 up = frame.up.normalized();
    const Vec3 side = up.cross(frame.front);
    require(frame.up.norm() > kNoLength && side.norm() > kNoLength * frame.front.norm(),
            "up and front of a part are directions at an angle to each other");
    Mat3 rotation;
    rotation.row(0) = side.normalized();
    rotation.row(1) = up;
    rotation.row(2) = side.normalized().cross(up);
    return rotation;
}

}  // namespace

void save_part(const Part& part, const PartFrame& frame, const std::filesystem::path& path,
               const Context& context) {
    require_part_format(path);
    require_same_topology(part.mesh, part.region.topology(), "the region");
    Mesh mesh = part.mesh;
    for (const char* name : {kRegionName, kFeatureName}) mesh.remove_region(name);
    mesh.set_region(kRegionName, part.region);
    if (part.feature) {
        require_same_topology(part.mesh, part.feature->topology(), "the feature");
        require(part.feature->minus(part.region).empty(), "the feature of a part is in its region");
        mesh.set_region(kFeatureName, *part.feature);
    }
    const Mat3 rotation = upright(frame);
    Mesh taken = extract(mesh, part.region.grown(kRingsAround), context).mesh;
    const Affine turn{rotation, Vec3::Zero()};
    if (!turn.is_identity()) transform(taken, turn, context);
    save_mesh(taken, path, {}, context);
}

Part load_part(const std::filesystem::path& path, const Context& context) {
    require_part_format(path);
    Mesh mesh = load_mesh(path, {}, context);
    const Region* region = mesh.find_region(kRegionName);
    if (!region) {
        throw Error(ErrorCode::unsupported,
                    display_name(path) +
                        " has no region called \"region\" around a feature; write "
                        "parts with lissom.part.save, or mark it and save the mesh");
    }
    const Region* feature = mesh.find_region(kFeatureName);
    Part part{mesh, *region, std::nullopt};
    if (feature) part.feature = *feature;
    return part;
}

}  // namespace lissom
