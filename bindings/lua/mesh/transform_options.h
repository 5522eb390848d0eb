/// Translation, rotation and scale as scripts give them; private to bindings/lua.
#pragma once

#include "bindings/lua/core/call.h"

namespace lissom::lua {

/// The options translate=, rotate={axis=,angle=,about=}, scale=, about= of a function.
std::vector<Parameter> transform_fields(const std::string& about_default);

/// Values of a call for them, as plain data: they can be read in step 1 and combined in step 3.
struct TransformOptions {
    Vec3 translate, scale, about, axis, rotate_about;
    double angle;
    bool has_about, has_rotate_about;

    /// `prefix` stands before the names: "handles." for fields of the option `handles`.
    static TransformOptions read(const Call& call, const char* prefix = "");
    /// The same for coordinates relative to `origin`.
    TransformOptions relative_to(const Vec3& origin) const;
    /// Returns the map that scales, then rotates, then translates; about `center` if the script
    /// named no point. Throws as rotation().
    Affine map(const Vec3& center) const;
    /// Its rotation vector, of any number of turns.
    Vec3 turn() const { return angle == 0.0 ? Vec3(Vec3::Zero()) : angle / axis.norm() * axis; }
};

/// The options {axis=, angle=, about=} of a function itself.
struct RotationOptions {
    Vec3 axis, about;
    double angle;
    bool has_about;

    static RotationOptions read(const Call& call);
    /// The same for coordinates relative to `origin`.
    RotationOptions relative_to(const Vec3& origin) const;
    /// Returns the map about `center` if the script named no point. Throws as rotation().
    Affine map(const Vec3& center) const;
    /// Its rotation vector, of any number of turns.
    Vec3 turn() const { return angle == 0.0 ? Vec3(Vec3::Zero()) : angle / axis.norm() * axis; }
};

}  // namespace lissom::lua
