#include "kernel/merge/loop/loop_fit.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "kernel/deform/rotation/polar.h"

namespace lissom {

LoopSamples::LoopSamples(const Loop& loop, const std::vector<Mat3>& frames, double start) {
    for (int k = 0; k < kLoopSamples; ++k) {
        const LoopPoint place = loop.place_at(start + static_cast<double>(k) / kLoopSamples);
        points[k] = point_of(loop.points(), place);
        normals[k] = interpolated(frames, place).col(1).normalized();
    }
}

SimilarityMap similarity_about(std::span<const Vec3> from, std::span<const Vec3> to,
                               const Vec3& from_center, const Vec3& to_center) {
    SimilarityMap s{Mat3::Identity(), 1.0, from_center, to_center};
    Mat3 products = Mat3::Zero();
    double from_squares = 0.0, to_squares = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const Vec3 a = from[i] - s.from, b = to[i] - s.to;
        products += b * a.transpose();
        from_squares += a.squaredNorm();
        to_squares += b.squaredNorm();
    }
    s.rotation = nearest_rotation(products / std::sqrt(from_squares * to_squares));
    s.scale = std::sqrt(to_squares / from_squares);
    return s;
}

SimilarityMap Matches::fit() const {
    const double n = from.size();
    Vec3 a = Vec3::Zero(), b = Vec3::Zero();
    for (const Vec3& p : from) a += p / n;
    for (const Vec3& p : to) b += p / n;
    return similarity_about(from, to, a, b);
}

SimilarityMap similarity_of(const Loop& source, const Loop& target, const LoopPair& pair) {
    Matches matches{source.points(), {}};
    for (const LoopPoint& place : pair.on_target) {
        matches.to.push_back(point_of(target.points(), place));
    }
    return matches.fit();
}

double loop_aspect(const Loop& loop) {
    Eigen::Matrix<double, 3, kLoopSamples> points;
    for (int k = 0; k < kLoopSamples; ++k) {
        const double at = static_cast<double>(k) / kLoopSamples;
        points.col(k) = point_of(loop.points(), loop.place_at(at)) - loop.center();
    }
    const Mat3 axes =
        Eigen::SelfAdjointEigenSolver<Mat3>(points * points.transpose()).eigenvectors();
    const auto width = [&](int k) {
        const auto along = (axes.col(k).transpose() * points).eval();
        return along.maxCoeff() - along.minCoeff();
    };
    return width(2) / width(1);
}

Mat3 shortest_turn(const Vec3& from, const Vec3& to) {
    const Vec3 across = from.cross(to);
    const double sine = across.norm(), cosine = from.dot(to);
    if (sine == 0.0 && cosine >= 0.0) return Mat3::Identity();
    const Vec3 axis = sine > 0.0 ? Vec3(across / sine) : from.unitOrthogonal();
    return Eigen::AngleAxisd(std::atan2(sine, cosine), axis).toRotationMatrix();
}

}  // namespace lissom
