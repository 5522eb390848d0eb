#include "kernel/io/usda/transform.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace lissom {
namespace {

constexpr std::string_view kOperation = "xformOp:", kInverse = "!invert!",
                           kReset = "!resetXformStack!";

// Exact for quarter turns, which files turned from z up to y up are full of.
Mat3 turn_about(int axis, double degrees) {
    const double quarters = degrees / 90.0;
    const double rest = std::remainder(quarters, 4.0);
    const double angle = degrees / 180.0 * kPi;
    const bool is_exact = quarters == std::floor(quarters);
    const double c = is_exact ? (rest == 0.0             ? 1.0
                                 : std::abs(rest) == 2.0 ? -1.0
                                                         : 0.0)
                              : std::cos(angle);
    const double s = is_exact ? (std::abs(rest) == 1.0 ? rest : 0.0) : std::sin(angle);
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    Mat3 turn = Mat3::Identity();
    turn(a, a) = turn(b, b) = c;
    turn(b, a) = s;
    turn(a, b) = -s;
    return turn;
}

// The number of the axis that a letter names, or -1.
int axis_of(char letter) {
    return letter >= 'X' && letter <= 'Z' ? letter - 'X' : -1;
}

Affine linear_map(const Mat3& matrix) {
    return {matrix, Vec3::Zero()};
}

Vec3 vector_of(const std::vector<double>& v) {
    return {v[0], v[1], v[2]};
}

Vec3 axis_vector(char letter, double value, double others) {
    Vec3 v = Vec3::Constant(others);
    v[axis_of(letter)] = value;
    return v;
}

// A rotation about three axes, the first letter's first.
Affine euler_turn(std::string_view axes, const std::vector<double>& degrees) {
    Mat3 turn = Mat3::Identity();
    for (const char letter : axes) {
        const int axis = axis_of(letter);
        turn = turn_about(axis, degrees[static_cast<std::size_t>(axis)]) * turn;
    }
    return linear_map(turn);
}

bool is_euler(std::string_view axes) {
    std::string sorted(axes);
    std::sort(sorted.begin(), sorted.end());
    return sorted == "XYZ";
}

bool is_one_axis(std::string_view axes) {
    return axes.size() == 1 && axis_of(axes[0]) >= 0;
}

// "rotateXYZ" of "xformOp:rotateXYZ:pivot".
std::string_view kind_of(std::string_view name) {
    name.remove_prefix(kOperation.size());
    return name.substr(0, name.find(':'));
}

std::string_view without_prefix(std::string_view prefix, std::string_view word) {
    return word.substr(word.starts_with(prefix) ? prefix.size() : 0);
}

// How many numbers an operation has; 0 if it is not known.
std::size_t width_of(std::string_view kind) {
    if (kind == "translate" || kind == "scale") return 3;
    if (kind == "orient") return 4;
    if (kind == "transform") return 16;
    for (const std::string_view verb : {"translate", "scale", "rotate"}) {
        if (!kind.starts_with(verb)) continue;
        const std::string_view axes = kind.substr(verb.size());
        if (is_one_axis(axes)) return 1;
        return verb == "rotate" && is_euler(axes) ? 3 : 0;
    }
    return 0;
}

[[noreturn]] void refuse_operation(ErrorCode code, std::string_view name, const std::string& what,
                                   FilePlace place) {
    refuse(code, "the transform " + in_quotes(name) + " " + what, place);
}

// USD multiplies rows by matrices: a translation stands in the last row.
Affine affine_of_rows(std::string_view name, const std::vector<double>& m, FilePlace place) {
    if (m[3] != 0.0 || m[7] != 0.0 || m[11] != 0.0 || m[15] != 1.0) {
        refuse_operation(ErrorCode::unsupported, name, "is not affine; apply it before exporting",
                         place);
    }
    Affine result;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            result.linear(row, column) =
                m[4U * static_cast<unsigned>(column) + static_cast<unsigned>(row)];
        }
    }
    result.translation = {m[12], m[13], m[14]};
    return result;
}

// The real part comes first.
Affine orientation(std::string_view name, const std::vector<double>& q, FilePlace place) {
    const Eigen::Quaterniond turn(q[0], q[1], q[2], q[3]);
    if (!(turn.norm() > 0.0)) {
        refuse_operation(ErrorCode::file_syntax, name, "is a quaternion of length 0", place);
    }
    return linear_map(turn.normalized().toRotationMatrix());
}

Affine affine_of(std::string_view name, const std::vector<double>& v, FilePlace place) {
    const std::string_view kind = kind_of(name);
    if (kind == "translate") return translation(vector_of(v));
    if (kind == "scale") return linear_map(vector_of(v).asDiagonal());
    if (kind == "orient") return orientation(name, v, place);
    if (kind == "transform") return affine_of_rows(name, v, place);
    const char last = kind.back();
    if (kind.starts_with("translate")) return translation(axis_vector(last, v[0], 0.0));
    if (kind.starts_with("scale")) return linear_map(axis_vector(last, v[0], 1.0).asDiagonal());
    const std::string_view axes = without_prefix("rotate", kind);
    return axes.size() == 1 ? linear_map(turn_about(axis_of(last), v[0])) : euler_turn(axes, v);
}

// False for NaN.
bool can_be_inverted(const Affine& map) {
    return std::abs(map.linear.determinant()) > 0.0;
}

Affine inverse_of(const Affine& map) {
    const Mat3 back = map.linear.inverse();
    return {back, -(back * map.translation)};
}

}  // namespace

void UsdaTransform::set_operation(std::string_view name, std::vector<double> numbers) {
    operations_[std::string(name)].numbers = std::move(numbers);
}

void UsdaTransform::set_changing(std::string_view name) {
    operations_[std::string(name)].changes = true;
}

void UsdaTransform::set_order(std::vector<std::string> order, FilePlace place) {
    order_ = std::move(order);
    place_ = place;
}

bool UsdaTransform::resets() const {
    return std::find(order_.begin(), order_.end(), kReset) != order_.end();
}

Affine UsdaTransform::value_of(const std::string& name) const {
    const auto found = operations_.find(name);
    if (!name.starts_with(kOperation) || width_of(kind_of(name)) == 0) {
        refuse_operation(ErrorCode::unsupported, name, "is not known; apply it before exporting",
                         place_);
    }
    if (found == operations_.end()) return {};
    const Operation& operation = found->second;
    if (operation.changes) {
        refuse_operation(ErrorCode::unsupported, name, "changes over time; export a single frame",
                         place_);
    }
    const std::size_t width = width_of(kind_of(name));
    if (operation.numbers.empty()) return {};
    if (operation.numbers.size() != width) {
        refuse_operation(ErrorCode::file_syntax, name,
                         "has " + std::to_string(operation.numbers.size()) + " numbers, not " +
                             std::to_string(width),
                         place_);
    }
    return affine_of(name, operation.numbers, place_);
}

Affine UsdaTransform::matrix_of(const std::string& entry) const {
    const std::string name(without_prefix(kInverse, entry));
    const Affine map = value_of(name);
    if (!map.is_finite()) refuse_operation(ErrorCode::not_finite, name, "is not finite", place_);
    if (!can_be_inverted(map)) {
        refuse_operation(ErrorCode::unsupported, name,
                         "flattens the curves; a scale of 0 cannot be read", place_);
    }
    return entry.starts_with(kInverse) ? inverse_of(map) : map;
}

Affine UsdaTransform::matrix() const {
    const auto reset = std::find(order_.rbegin(), order_.rend(), kReset);
    Affine result;
    for (auto entry = reset.base(); entry != order_.end(); ++entry) {
        result = result * matrix_of(*entry);
    }
    if (result.is_finite()) return result;
    refuse(ErrorCode::not_finite, "the transform exceeds the range of numbers", place_);
}

}  // namespace lissom
