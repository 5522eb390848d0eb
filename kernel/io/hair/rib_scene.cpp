#include "kernel/io/hair/rib_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "kernel/core/error.h"
#include "kernel/io/hair/rib_curves.h"
#include "kernel/io/stream/text_writer.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {
namespace {

// Linear.
constexpr const char* kRibSkin = "Color [ 0.55 0.5 0.46 ]\n";
constexpr const char* kRibHair = "Color [ 0.26 0.15 0.075 ]\n";

// The lights of all pictures (viewer/studio_light.h), towards the light in the axes of the camera:
// right, up, towards the viewer; linear colours.
struct RibLight {
    Vec3 towards, color;
};
const std::array<RibLight, 3> kRibLights = {{{{-0.62, 0.62, 0.48}, {1.1, 1.08, 1.04}},
                                             {{0.8, 0.05, 0.55}, {0.13, 0.14, 0.16}},
                                             {{0.45, 0.45, -0.55}, {0.22, 0.235, 0.25}}}};
constexpr const char* kRibAmbient =
    "LightSource \"ambientlight\" 1 \"intensity\" [ 0.3 ] \"lightcolor\" [ 1 1 1 ]\n";

// Near plane as a fraction of the distance of the camera.
constexpr double kRibNearest = 1e-3;

void append_vector(std::string& text, const Vec3& v) {
    append_numbers(text, std::span(v.data(), 3));
}

// Returns a camera that sees head and hair whole.
Camera framing_camera(const RibScene& scene, const Box& content) {
    FramingOptions framing;
    framing.fov = kPi * 24.0 / 180.0;
    framing.aspect = 1.0 * scene.width / scene.height;
    const Box unit{-Vec3::Ones(), Vec3::Ones()};
    return frame_box(StandardView::three_quarter, content.empty() ? unit : content, framing);
}

Camera moved_camera(const Camera& camera, const Affine& map) {
    CameraOptions options = camera.options();
    options.eye = map(options.eye);
    options.target = map(options.target);
    options.up = map.linear * camera.up();
    if (options.ortho) *options.ortho *= (map.linear * camera.up()).norm();
    return Camera(options);
}

}  // namespace

RibSceneWriter::RibSceneWriter(const RibScene& scene, const Box& hair, const Affine& placement,
                               const Context& context)
    : scene_(scene), context_(context), of_metres_(placement) {
    if (scene.width < 1 || scene.height < 1) {
        throw Error(ErrorCode::invalid_argument,
                    "the picture of a RIB scene needs a width and a "
                    "height of at least 1 pixel");
    }
    const double unit = scene.unit.value_or(1.0);
    if (!(unit > 0.0) || !std::isfinite(unit)) {
        throw Error(ErrorCode::invalid_argument, "the unit of the head must be above 0");
    }
    const Affine to_metres{unit * Mat3::Identity(), Vec3::Zero()};
    of_head_ = of_metres_ * to_metres;
    Box content = hair;
    if (scene.head) {
        for (const Vec3& p : scene.head->positions()) content.extend(to_metres(p));
    }
    camera_ = scene.camera ? moved_camera(Camera(*scene.camera), of_head_)
                           : moved_camera(framing_camera(scene, content), of_metres_);
    const Vec3 center = content.empty() ? camera_.target() : of_metres_(content.center());
    const double radius = 0.5 * content.diagonal() * of_metres_.linear.col(0).norm();
    const double distance = (center - camera_.eye()).norm();
    far_ = 2.0 * (distance + radius);
    near_ = std::max(kRibNearest * far_, 0.5 * (distance - radius));
}

void RibSceneWriter::begin(std::string& text) const {
    const std::string picture = scene_.picture.empty() ? "hair.tif" : scene_.picture;
    text += "Display " + rib_text(picture) + " \"file\" \"rgba\"\n";
    text += "Format " + std::to_string(scene_.width) + " " + std::to_string(scene_.height) + " 1\n";
    text += "PixelSamples 4 4\nPixelFilter \"gaussian\" 2 2\nShadingRate 1\n";
    write_camera(text);
    text += "WorldBegin\n";
    write_lights(text);
    if (scene_.head) write_head(text);
    text += std::string(
                "Surface \"plastic\" \"Ka\" [ 1 ] \"Kd\" [ 0.9 ] \"Ks\" [ 0.35 ] "
                "\"roughness\" [ 0.15 ]\n") +
            kRibHair;
}

void RibSceneWriter::end(std::string& text) {
    text += "WorldEnd\n";
}

// The camera of RenderMan looks along +z, x to the right and y up, so its space is left-handed;
// points are rows.
void RibSceneWriter::write_camera(std::string& text) const {
    const double aspect = 1.0 * scene_.width / scene_.height;
    const double half = camera_.is_ortho() ? camera_.half_height(0.0) : 1.0;
    text += "ScreenWindow";
    append_numbers(text, std::array{-aspect * half, aspect * half, -half, half});
    text += "\nClipping";
    append_numbers(text, std::array{near_, far_});
    if (camera_.is_ortho()) {
        text += "\nProjection \"orthographic\"\n";
    } else {
        text += "\nProjection \"perspective\" \"fov\" [";
        append_numbers(text, std::array{camera_.fov() * 180.0 / kPi});
        text += " ]\n";
    }
    Mat3 axes;
    axes << camera_.right().transpose(), camera_.up().transpose(), camera_.forward().transpose();
    const Vec3 origin = -(axes * camera_.eye());
    text += "ConcatTransform [";
    for (int row = 0; row < 3; ++row) {
        append_vector(text, axes.col(row));
        text += " 0";
    }
    append_vector(text, origin);
    text += " 1 ]\n";
}

void RibSceneWriter::write_lights(std::string& text) const {
    text += kRibAmbient;
    int handle = 1;
    for (const RibLight& light : kRibLights) {
        const Vec3 towards = light.towards.x() * camera_.right() +
                             light.towards.y() * camera_.up() -
                             light.towards.z() * camera_.forward();
        text += "LightSource \"distantlight\" " + std::to_string(++handle) +
                " \"intensity\" [ 1 ] \"lightcolor\" [";
        append_vector(text, light.color);
        text += " ] \"from\" [";
        append_vector(text, towards);
        text += " ] \"to\" [ 0 0 0 ]\n";
    }
}

void RibSceneWriter::write_head(std::string& text) const {
    const Mesh& head = *scene_.head;
    const auto faces = triangulate_faces(head.topology(), head.positions());
    text += "AttributeBegin\nAttribute \"identifier\" \"string name\" [\"head\"]\n";
    text += "Surface \"matte\" \"Ka\" [ 1 ] \"Kd\" [ 0.9 ]\n";
    text += kRibSkin;
    text += "PointsPolygons [";
    for (std::size_t t = 0; t < faces.triangles.size(); ++t) text += t % 24 == 23 ? "\n3" : " 3";
    text += " ]\n[";
    for (std::size_t t = 0; t < faces.triangles.size(); ++t) {
        if (t % 8 == 7) {
            text += '\n';
            context_.checkpoint();
        }
        append_numbers(text, faces.triangles[t]);
    }
    text += " ]\n\"P\" [";
    const auto append_lines = [&](Index count, const auto& vector) {
        for (Index v = 0; v < count; ++v) {
            if (v % 8 == 7) text += '\n';
            const Eigen::Vector3f value = vector(v).template cast<float>();
            append_numbers(text, std::span(value.data(), 3));
        }
        text += " ]\n";
    };
    append_lines(head.vertex_count(), [&](Index v) { return of_head_(head.position(v)); });
    const std::vector<Vec3> normals = vertex_normals(head);
    text += "\"N\" [";
    append_lines(head.vertex_count(),
                 [&](Index v) -> Vec3 { return (of_head_.linear * normals[v]).normalized(); });
    text += "AttributeEnd\n";
}

}  // namespace lissom
