#include "kernel/hair/curve_conflicts.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace lissom {
namespace {

// A constraint and the place of its claim.
struct Said {
    GridConstraint* constraint;
    int rank;
    std::size_t claim;
};

bool agree(const Vec3& a, const Vec3& b) {
    return a.dot(b) >= std::cos(kAgreement) * a.norm() * b.norm();
}

// `said`: all that is said of one point, the decisive one first.
void settle(std::span<const Said> said) {
    const GridConstraint first = *said.front().constraint;
    Vec3 sum = Vec3::Zero();
    double total = 0.0;
    for (const Said& one : said) {
        if (one.rank != said.front().rank || !agree(one.constraint->value, first.value)) continue;
        const double share = one.constraint->weight * one.constraint->weight;
        sum += share * one.constraint->value;
        total += share;
    }
    for (const Said& one : said) {
        *one.constraint = {first.point, sum / total, first.weight, first.tag};
    }
}

}  // namespace

void settle_conflicts(std::vector<CurveClaim>& claims) {
    std::vector<Said> said;
    for (std::size_t c = 0; c < claims.size(); ++c) {
        for (GridConstraint& one : claims[c].constraints) said.push_back({&one, claims[c].rank, c});
    }
    std::sort(said.begin(), said.end(), [](const Said& a, const Said& b) {
        if (a.constraint->point != b.constraint->point) {
            return a.constraint->point < b.constraint->point;
        }
        return a.rank != b.rank ? a.rank > b.rank : a.claim > b.claim;
    });
    for (std::size_t begin = 0; begin < said.size();) {
        std::size_t end = begin + 1;
        while (end < said.size() && said[end].constraint->point == said[begin].constraint->point) {
            ++end;
        }
        if (end - begin > 1) settle(std::span(said).subspan(begin, end - begin));
        begin = end;
    }
}

}  // namespace lissom
