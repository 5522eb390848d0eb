/// Heads and checks shared by the tests of kernel/hair.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "kernel/io/mesh_file.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"
#include "tests/unit/hair/threads.h"
#include "tests/unit/shapes.h"
#include "tests/unit/support.h"

namespace lissom::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A real head, or nothing, with a message, where the data is absent.
inline std::optional<Mesh> load_head(const std::string& name) {
    const auto path = data_file("heads/" + name);
    if (!path) return std::nullopt;
    return load_mesh(*path);
}

/// Random points that are the same on every platform.
class RandomPoints {
  public:
    explicit RandomPoints(std::uint32_t seed) : engine_(seed) {}
    double uniform(double low, double high) {
        return low + (high - low) * (engine_() / 4294967296.0);
    }
    Vec3 in_box(const Box& box) {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = uniform(box.min[axis], box.max[axis]);
        return p;
    }

  private:
    std::mt19937 engine_;
};

inline Box grown(Box box, double share) {
    const Vec3 margin = share * (box.max - box.min);
    return {box.min - margin, box.max + margin};
}

/// Generalised winding number: the solid angles of all triangles (Van Oosterom and Strackee 1983).
class WindingNumber {
  public:
    explicit WindingNumber(const Mesh& mesh) {
        for (const auto& [i, j, k] :
             triangulate_faces(mesh.topology(), mesh.positions()).triangles) {
            triangles_.push_back({mesh.position(i), mesh.position(j), mesh.position(k)});
        }
    }
    double operator()(const Vec3& p) const {
        double sum = 0.0;
        for (const std::array<Vec3, 3>& triangle : triangles_) {
            const Vec3 a = triangle[0] - p, b = triangle[1] - p, c = triangle[2] - p;
            const double u = a.norm(), v = b.norm(), w = c.norm();
            sum += std::atan2(a.dot(b.cross(c)),
                              u * v * w + a.dot(b) * w + b.dot(c) * u + c.dot(a) * v);
        }
        return sum / (2.0 * kPi);
    }

  private:
    std::vector<std::array<Vec3, 3>> triangles_;
};

}  // namespace lissom::test
