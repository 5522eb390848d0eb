#include "bindings/lua/mesh/transform_options.h"

#include <array>
#include <cstdio>

#include "bindings/lua/core/kernel_library.h"

namespace lissom::lua {
namespace {

constexpr double kRadians = kPi / 180.0;

// Paths of options behind a prefix, without memory of its own: a Lua error may skip destructors.
class OptionPath {
  public:
    using Text = std::array<char, 64>;

    explicit OptionPath(const char* prefix) : prefix_(prefix) {}

    Text operator()(const char* name) const {
        Text text{};
        std::snprintf(text.data(), text.size(), "%s%s", prefix_, name);
        return text;
    }

  private:
    const char* prefix_;
};

}  // namespace

std::vector<Parameter> transform_fields(const std::string& about_default) {
    return {vector("translate", "Added last.").optional("{0, 0, 0}").in("mesh units"),
            options("rotate", rotation_fields("the option `about`"), "Applied after the scale.")
                .optional("none"),
            factors("scale", "Factor for all axes, or one for each; applied first.").optional("1"),
            vector("about", "The point that scale and rotation keep.").optional(about_default)};
}

TransformOptions TransformOptions::read(const Call& call, const char* prefix) {
    const OptionPath path(prefix);
    const auto vector_or = [&](const char* name, const Vec3& otherwise) {
        const OptionPath::Text full = path(name);
        return call.has(full.data()) ? call.vector(full.data()) : otherwise;
    };
    TransformOptions options;
    options.translate = vector_or("translate", Vec3::Zero());
    options.scale = vector_or("scale", Vec3::Ones());
    options.about = vector_or("about", Vec3::Zero());
    options.axis = vector_or("rotate.axis", Vec3::UnitY());
    options.rotate_about = vector_or("rotate.about", options.about);
    const OptionPath::Text angle = path("rotate.angle");
    options.angle = call.has(angle.data()) ? call.number(angle.data()) * kRadians : 0.0;
    options.has_about = call.has(path("about").data());
    options.has_rotate_about = options.has_about || call.has(path("rotate.about").data());
    return options;
}

TransformOptions TransformOptions::relative_to(const Vec3& origin) const {
    TransformOptions moved = *this;
    moved.about -= origin;
    moved.rotate_about -= origin;
    return moved;
}

Affine TransformOptions::map(const Vec3& center) const {
    Affine map;
    if (scale != Vec3::Ones()) map = scaling(scale, has_about ? about : center);
    if (angle != 0.0) map = rotation(axis, angle, has_rotate_about ? rotate_about : center) * map;
    if (translate != Vec3::Zero()) map = translation(translate) * map;
    return map;
}

RotationOptions RotationOptions::read(const Call& call) {
    const bool has_about = call.has("about");
    return {call.vector("axis"), has_about ? call.vector("about") : Vec3(Vec3::Zero()),
            call.number("angle") * kRadians, has_about};
}

RotationOptions RotationOptions::relative_to(const Vec3& origin) const {
    return {axis, about - origin, angle, has_about};
}

Affine RotationOptions::map(const Vec3& center) const {
    return rotation(axis, angle, has_about ? about : center);
}

}  // namespace lissom::lua
