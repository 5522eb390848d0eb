#include "kernel/merge/loop/correspondence.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kernel/core/error.h"

namespace lissom {
namespace {

// A point this far from its loop, in loop lengths, is not on it.
constexpr double kOffLoop = 0.1;
// Keys closer than this part of the loop are at one place.
constexpr double kSamePlace = 1e-9;
// Part of the local spacing within which vertices meet: by snapping, and by coincidence but for
// rounding.
constexpr double kSnap = 0.3;
constexpr double kRoundedApart = 1e-9;

double wrapped(double u) {
    const double w = u - std::floor(u);
    return w < 1.0 ? w : 0.0;
}

// How far ahead of `from` a parameter lies, 0 to 1.
double ahead(double from, double u) {
    return wrapped(u - from);
}

[[noreturn]] void refuse_key(std::size_t key, const std::string& why, Elements elements) {
    throw Error(ErrorCode::key_conflict, "key " + std::to_string(key + 1) + " " + why,
                std::move(elements));
}

double parameter_of_key(const Loop& loop, const Key& key, std::size_t number, const char* side) {
    const std::string boundary = std::string("the ") + side + "'s boundary";
    if (const Index* vertex = std::get_if<Index>(&key)) {
        const std::vector<Index>& ids = loop.vertices();
        const auto at = std::find(ids.begin(), ids.end(), *vertex);
        if (at != ids.end()) return loop.parameters()[at - ids.begin()];
        Elements elements{ElementKind::vertex, 0, {}};
        elements.add(*vertex);
        const std::string name = describe(elements);
        refuse_key(number,
                   "is " + name + ", which is not on " + boundary +
                       "; choose one of its vertices, or give a point",
                   std::move(elements));
    }
    double distance = 0.0;
    const LoopPoint place = loop.nearest(std::get<Vec3>(key), distance);
    if (!(distance <= kOffLoop * loop.length())) {
        Elements elements{ElementKind::vertex, 0, {}};
        elements.add(loop.vertices()[place.segment]);
        refuse_key(number,
                   "lies off " + boundary + ", " + std::to_string(distance) +
                       " from it; give a point on it",
                   std::move(elements));
    }
    return loop.parameter_of(place);
}

void require_apart(const std::vector<ParameterPair>& keys, const std::vector<std::size_t>& order) {
    for (std::size_t k = 0; keys.size() > 1 && k < keys.size(); ++k) {
        const std::size_t a = order[k], b = order[(k + 1) % order.size()];
        const double gap = ahead(keys[a].target, keys[b].target);
        if (gap > kSamePlace && gap < 1.0 - kSamePlace) continue;
        throw Error(ErrorCode::key_conflict,
                    "keys " + std::to_string(a + 1) + " and " + std::to_string(b + 1) +
                        " are at one place of the target's boundary; drop one of them");
    }
}

// Steps along the source between keys in the target's order must come to once around.
void require_same_order(const std::vector<ParameterPair>& keys,
                        const std::vector<std::size_t>& order) {
    double around = 0.0;
    for (std::size_t k = 0; keys.size() > 1 && k < keys.size(); ++k) {
        const std::size_t a = order[k], b = order[(k + 1) % order.size()];
        const double gap = ahead(keys[a].source, keys[b].source);
        if (gap <= kSamePlace || gap >= 1.0 - kSamePlace) {
            throw Error(ErrorCode::key_conflict,
                        "keys " + std::to_string(a + 1) + " and " + std::to_string(b + 1) +
                            " are at one place of the source's boundary; drop one of them");
        }
        around += gap;
        if (around <= 1.0 + 1e-6) continue;
        throw Error(ErrorCode::key_conflict,
                    "keys " + std::to_string(a + 1) + " and " + std::to_string(b + 1) +
                        " follow each other the other way round on the source's boundary than on "
                        "the target's; exchange them, or mirror the source");
    }
}

// Image of each parameter of one loop on the other, linear between keys.
double carried(double u, std::span<const ParameterPair> keys, double ParameterPair::*from,
               double ParameterPair::*to) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < keys.size(); ++k) {
        if (ahead(keys[k].*from, u) < ahead(keys[best].*from, u)) best = k;
    }
    const ParameterPair& a = keys[best];
    const ParameterPair& b = keys[(best + 1) % keys.size()];
    const bool alone = keys.size() == 1;
    const double span_from = alone ? 1.0 : ahead(a.*from, b.*from);
    const double span_to = alone ? 1.0 : ahead(a.*to, b.*to);
    return wrapped(a.*to + ahead(a.*from, u) / span_from * span_to);
}

// Parameters in ascending order from the first, without wrap: each at least the one before.
std::vector<double> unwound(std::vector<double> u) {
    for (std::size_t k = 1; k < u.size(); ++k) {
        u[k] = u[k - 1] + ahead(u[k - 1], u[k]);
    }
    return u;
}

double spacing(const std::vector<double>& u, Index k) {
    const auto n = count_of(u);
    const double before = ahead(u[(k + n - 1) % n], u[k]), after = ahead(u[k], u[(k + 1) % n]);
    return std::min(before, after);
}

// The vertex of the target that each source vertex meets, or kNoIndex. Each target vertex meets the
// nearest one only; as places ascend, so do the vertices met.
std::vector<Index> meetings(const std::vector<double>& source, const std::vector<double>& target,
                            double reach) {
    const auto n = count_of(source), m = count_of(target);
    std::vector<Index> met(source.size(), kNoIndex), taker(target.size(), kNoIndex);
    std::vector<double> gap(target.size(), 1.0);
    for (Index i = 0; i < n; ++i) {
        const auto after = std::upper_bound(target.begin(), target.end(), source[i]);
        const Index right = index_of(after - target.begin()) % m;
        for (const Index j : {(right + m - 1) % m, right}) {
            const double d = std::min(ahead(target[j], source[i]), ahead(source[i], target[j]));
            if (d > reach * std::min(spacing(source, i), spacing(target, j)) || d >= gap[j])
                continue;
            gap[j] = d;
            taker[j] = i;
        }
    }
    for (Index j = 0; j < m; ++j) {
        if (taker[j] != kNoIndex && met[taker[j]] == kNoIndex) met[taker[j]] = j;
    }
    return met;
}

}  // namespace

std::vector<ParameterPair> key_parameters(const Loop& source, const Loop& target,
                                          std::span<const KeyPair> keys) {
    std::vector<ParameterPair> result;
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < keys.size(); ++k) {
        result.push_back({parameter_of_key(source, keys[k].source, k, "source"),
                          parameter_of_key(target, keys[k].target, k, "target")});
        order.push_back(k);
    }
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return result[a].target < result[b].target; });
    require_apart(result, order);
    require_same_order(result, order);
    std::vector<ParameterPair> sorted;
    for (const std::size_t k : order) sorted.push_back(result[k]);
    return sorted;
}

LoopPair corresponding(const Loop& source, const Loop& target, std::span<const ParameterPair> keys,
                       bool snap) {
    LoopPair pair{source.vertices(), target.vertices(), {}, {}};
    std::vector<double> at;
    for (const double u : source.parameters()) {
        at.push_back(carried(u, keys, &ParameterPair::source, &ParameterPair::target));
    }
    const std::vector<Index> met = meetings(at, target.parameters(), snap ? kSnap : kRoundedApart);
    for (Index i = 0; i < source.size(); ++i) {
        pair.on_target.push_back(met[i] != kNoIndex ? LoopPoint{met[i], 0.0}
                                                    : target.place_at(at[i]));
        at[i] = target.parameter_of(pair.on_target.back());
    }
    // Between two source vertices the target's lie by arc length along the target.
    const std::vector<double> places = unwound(at);
    const double last = places.front() + 1.0;
    for (const double u : target.parameters()) {
        const double v = places.front() + ahead(places.front(), u);
        const auto after = std::upper_bound(places.begin(), places.end(), v);
        const auto k = index_of(after - places.begin()) - 1;
        const double to = k + 1 < source.size() ? places[k + 1] : last;
        const double t = to > places[k] ? (v - places[k]) / (to - places[k]) : 0.0;
        pair.on_source.push_back(t < 1.0 ? LoopPoint{k, t}
                                         : LoopPoint{(k + 1) % source.size(), 0.0});
    }
    for (Index i = 0; i < source.size(); ++i) {
        if (met[i] != kNoIndex) pair.on_source[met[i]] = {i, 0.0};
    }
    return pair;
}

}  // namespace lissom
