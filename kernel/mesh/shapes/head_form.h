/// The form of the generated head as an implicit function; private to kernel/mesh.
#pragma once

#include "kernel/core/geometry.h"

namespace lissom {

/// The form stands between these heights, in metres; the origin lies between the ears.
inline constexpr double kHeadBottom = -0.3, kHeadTop = 0.1;

/// Box that holds the form.
Box head_form_box();

/// The form of a head, as fine as a mesh with cells of a given size can show it: thin parts are no
/// thinner than such a mesh needs, and details smaller than the cells are left out.
class HeadForm {
  public:
    /// `cell`: longest edge of the cells at the face, in metres; 0 gives the form as it is.
    explicit HeadForm(double cell = 0.0);

    /// About the distance to the surface, negative inside. Even in x to the bit.
    double operator()(const Vec3& p) const;
    /// Returns the derivative, by differences.
    Vec3 gradient(const Vec3& p) const;
    /// About the distance to the ears alone.
    double ears(const Vec3& p) const;

  private:
    double half(const Vec3& p) const;
    double eye(const Vec3& p, double rest) const;
    double mouth(const Vec3& p, double rest) const;
    double nose(const Vec3& p, double rest) const;
    double ear(const Vec3& p) const;

    double cell_;
    /// Least half thickness of the shell of an ear.
    double shell_;
};

}  // namespace lissom
