/// The form of the generated head as an implicit function; private to kernel/mesh.
#pragma once

#include "kernel/core/geometry.h"

namespace lissom {

/// The form stands between these heights, in metres; the origin lies between the ears.
inline constexpr double kHeadBottom = -0.3, kHeadTop = 0.1;

/// Box that holds the form.
Box head_form_box();

/// About the distance to the surface of the form, negative inside. Even in x to the bit.
double head_form(const Vec3& p);

/// The derivative of `head_form`, by differences.
Vec3 head_form_gradient(const Vec3& p);

/// About the distance to the ears alone.
double head_ears(const Vec3& p);

}  // namespace lissom
