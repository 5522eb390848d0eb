#include "kernel/hair/dynamics/rod_system.h"

#include <algorithm>
#include <cmath>

namespace lissom {

RodSystem::RodSystem(std::size_t points)
    : size_(3 * points), band_(kBand * size_, 0.0), right_(size_, 0.0) {}

void RodSystem::add(std::size_t row, std::size_t column, const Mat3& block) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t last = row == column ? i : 2;
        for (std::size_t j = 0; j <= last; ++j) {
            entry(3 * row + i, 3 * column + j) += block(index_of(i), index_of(j));
        }
    }
}

void RodSystem::push(std::size_t row, const Vec3& value) {
    for (std::size_t i = 0; i < 3; ++i) right_[3 * row + i] += value[index_of(i)];
}

void RodSystem::factor() {
    for (std::size_t i = 0; i < size_; ++i) {
        const std::size_t first = i < kBand - 1 ? 0 : i - (kBand - 1);
        for (std::size_t j = first; j <= i; ++j) {
            double sum = entry(i, j);
            const std::size_t from = std::max(first, j < kBand - 1 ? 0 : j - (kBand - 1));
            for (std::size_t k = from; k < j; ++k) sum -= entry(i, k) * entry(j, k);
            entry(i, j) = i == j ? std::sqrt(sum) : sum / entry(j, j);
        }
    }
}

void RodSystem::solve() {
    factor();
    for (std::size_t i = 0; i < size_; ++i) {
        const std::size_t first = i < kBand - 1 ? 0 : i - (kBand - 1);
        for (std::size_t k = first; k < i; ++k) right_[i] -= entry(i, k) * right_[k];
        right_[i] /= entry(i, i);
    }
    for (std::size_t i = size_; i-- > 0;) {
        right_[i] /= entry(i, i);
        const std::size_t first = i < kBand - 1 ? 0 : i - (kBand - 1);
        for (std::size_t k = first; k < i; ++k) right_[k] -= entry(i, k) * right_[i];
    }
}

Vec3 RodSystem::result(std::size_t point) const {
    return {right_[3 * point], right_[3 * point + 1], right_[3 * point + 2]};
}

}  // namespace lissom
