#include "kernel/solve/sparse/single_factor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/solve/sparse/supernodal_loops.h"

namespace lissom {
namespace {

// Units of parallel work. A constant, so that sums do not depend on the number of threads.
constexpr std::size_t kSingleBins = 8;

// Subtrees are split further while they hold more than this share of the factor.
constexpr double kSingleLargestShare = 1.0 / 24.0;

using View = SupernodalView<float>;

LISSOM_INLINE void lower_range(const View& factor, Index first, Index last, Lanes<float>* x,
                               Lanes<float>* below) {
    for (Index s = first; s < last; ++s) solve_lower(factor, s, x, below);
}

LISSOM_INLINE void upper_range(const View& factor, Index first, Index last, Lanes<float>* x,
                               Lanes<float>* below) {
    for (Index s = last; s-- > first;) solve_upper(factor, s, x, below);
}

void lower_anywhere(const View& factor, Index first, Index last, Lanes<float>* x,
                    Lanes<float>* below) {
    lower_range(factor, first, last, x, below);
}

void upper_anywhere(const View& factor, Index first, Index last, Lanes<float>* x,
                    Lanes<float>* below) {
    upper_range(factor, first, last, x, below);
}

#ifdef LISSOM_HAS_AVX2_PATH
LISSOM_AVX2 void lower_with_avx2(const View& factor, Index first, Index last, Lanes<float>* x,
                                 Lanes<float>* below) {
    lower_range(factor, first, last, x, below);
}

LISSOM_AVX2 void upper_with_avx2(const View& factor, Index first, Index last, Lanes<float>* x,
                                 Lanes<float>* below) {
    upper_range(factor, first, last, x, below);
}
#endif

using Sweep = void (*)(const View&, Index, Index, Lanes<float>*, Lanes<float>*);

struct Sweeps {
    Sweep lower, upper;
};

Sweeps choose_sweeps() {
#ifdef LISSOM_HAS_AVX2_PATH
    if (has_avx2()) return {lower_with_avx2, upper_with_avx2};
#endif
    return {lower_anywhere, upper_anywhere};
}

Lanes<float> to_lanes(const Vec3& v, double factor) {
    Lanes<float> lanes{};
    for (int c = 0; c < 3; ++c) lanes[c] = static_cast<float>(factor * v[c]);
    return lanes;
}

Vec3 from_lanes(const Lanes<float>& lanes, double factor) {
    return {factor * lanes[0], factor * lanes[1], factor * lanes[2]};
}

double max_component(std::span<const Vec3> rows) {
    double greatest = 0.0;
    for (const Vec3& row : rows) greatest = std::max(greatest, row.cwiseAbs().maxCoeff());
    return greatest;
}

// One solve over ranges of supernodes: unknowns in the order of elimination at `at`, and for each
// bin room for the rows below a supernode.
class SingleSolve {
  public:
    SingleSolve(const View& view, const std::vector<Index>& permutation, std::span<const Vec3> b,
                std::span<Vec3> x, Lanes<float>* at, Lanes<float>* below, Index tallest, double in,
                double out)
        : view_(view),
          permutation_(permutation),
          b_(b),
          x_(x),
          at_(at),
          below_(below),
          tallest_(tallest),
          in_(in),
          out_(out) {}

    void read(Index first, Index last) const {
        for (Index i = view_.super[first]; i < view_.super[last]; ++i) {
            at_[i] = to_lanes(b_[permutation_[i]], in_);
        }
    }

    void write(Index first, Index last) const {
        for (Index i = view_.super[first]; i < view_.super[last]; ++i) {
            x_[permutation_[i]] = from_lanes(at_[i], out_);
        }
    }

    void lower(Index first, Index last, Index bin) const {
        sweeps_.lower(view_, first, last, at_, below_of(bin));
    }

    void upper(Index first, Index last, Index bin) const {
        sweeps_.upper(view_, first, last, at_, below_of(bin));
    }

  private:
    Lanes<float>* below_of(Index bin) const {
        return below_ + static_cast<std::ptrdiff_t>(bin) * tallest_;
    }

    View view_;
    const std::vector<Index>& permutation_;
    std::span<const Vec3> b_;
    std::span<Vec3> x_;
    Lanes<float>* at_;
    Lanes<float>* below_;
    Index tallest_;
    double in_, out_;
    Sweeps sweeps_ = choose_sweeps();
};

}  // namespace

SingleFactor::SingleFactor(Supernodes supernodes, std::vector<Index> permutation,
                           const Context& context)
    : nodes_(std::move(supernodes)), permutation_(std::move(permutation)) {
    charge_ =
        context.charge(nodes_.value.size() * sizeof(float) + nodes_.row.size() * sizeof(Index),
                       "a single-precision copy of a factor");
    for (Index s = 0; s < nodes_.count(); ++s) tallest_ = std::max(tallest_, nodes_.height(s));
    extended_size_ = size();
    split();
    fill_bins();
}

// Cuts the elimination tree below its upper part. Subtrees are contiguous if the tree is
// postordered; otherwise everything counts as the upper part.
void SingleFactor::split() {
    const Index count = nodes_.count();
    const std::vector<Index>& parent = nodes_.parent;
    std::vector<Index> first(count), members(first.size(), 1);
    std::vector<std::size_t> work(first.size(), 0);
    bool postordered = true;
    std::size_t total = 0;
    for (Index s = 0; s < count; ++s) first[s] = s;
    for (Index s = 0; s < count; ++s) {
        const auto own = at(nodes_.columns(s)) * nodes_.height(s);
        work[s] += own;
        total += own;
        postordered = postordered && s - first[s] + 1 == members[s];
        if (parent[s] == count) continue;
        work[parent[s]] += work[s];
        members[parent[s]] += members[s];
        first[parent[s]] = std::min(first[parent[s]], first[s]);
    }
    const double largest = kSingleLargestShare * total;
    const auto is_small = [&](Index s) { return postordered && work[s] <= largest; };
    for (Index s = 0; s < count; ++s) {
        if (!is_small(s)) {
            top_.push_back(s);
        } else if (parent[s] == count || !is_small(parent[s])) {
            add_subtree(first[s], s, work[s]);
        }
    }
}

// Rows above a subtree are those of its root. Its blocks refer to their entries in the extension.
void SingleFactor::add_subtree(Index first, Index root, std::size_t work) {
    Subtree& subtree = subtrees_.emplace_back();
    subtree.first = first;
    subtree.last = root + 1;
    subtree.extension = extended_size_;
    subtree.work = work;
    const auto begin = nodes_.row.begin() + nodes_.first_row[root] + nodes_.columns(root);
    subtree.above.assign(begin, nodes_.row.begin() + nodes_.first_row[root + 1]);
    const Index end_column = nodes_.super[root + 1];
    for (Index r = nodes_.first_row[first]; r < nodes_.first_row[root + 1]; ++r) {
        Index& row = nodes_.row[r];
        if (row < end_column) continue;
        const auto at = std::lower_bound(subtree.above.begin(), subtree.above.end(), row);
        row = subtree.extension + index_of(at - subtree.above.begin());
    }
    extended_size_ += count_of(subtree.above);
}

// Greatest subtrees first, each into the bin with the least work.
void SingleFactor::fill_bins() {
    std::vector<Index> order(subtrees_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = index_of(i);
    std::stable_sort(order.begin(), order.end(),
                     [&](Index a, Index b) { return subtrees_[a].work > subtrees_[b].work; });
    bins_.resize(std::min(kSingleBins, subtrees_.size()));
    std::vector<std::size_t> load(bins_.size(), 0);
    for (const Index i : order) {
        const auto bin = std::min_element(load.begin(), load.end()) - load.begin();
        bins_[bin].push_back(i);
        load[bin] += subtrees_[i].work;
    }
}

template <typename Pass>
void SingleFactor::for_each_bin(const Context& context, const Pass& pass) const {
    context.parallel_for(0, count_of(bins_), 1, [&](Index begin, Index end) {
        for (Index bin = begin; bin < end; ++bin) {
            for (const Index i : bins_[bin]) pass(subtrees_[i], bin);
        }
    });
}

void SingleFactor::solve(std::span<const Vec3> b, std::span<Vec3> x, Scratch& scratch,
                         const Context& context) const {
    if (b.size() != permutation_.size() || x.size() != permutation_.size()) {
        throw Error(ErrorCode::invalid_argument, "b and x must have one row for each unknown");
    }
    const double greatest = max_component(b);
    if (!(greatest > 0.0)) {
        std::fill(x.begin(), x.end(), Vec3::Zero());
        return;
    }
    const std::size_t lanes = extended_size_ + (bins_.size() + 1) * tallest_;
    scratch.resize(4 * lanes);
    auto* const at = reinterpret_cast<Lanes<float>*>(scratch.data());
    const auto own_bin = count_of(bins_);
    const View view{nodes_.super.data(), nodes_.first_row.data(), nodes_.first_value.data(),
                    nodes_.row.data(), nodes_.value.data()};
    // The factor was divided by `scale`: L L^T stands for A / scale^2.
    const SingleSolve work(view, permutation_, b, x, at, at + extended_size_, tallest_,
                           1.0 / greatest, greatest / (nodes_.scale * nodes_.scale));

    for_each_bin(context, [&](const Subtree& t, Index bin) {
        work.read(t.first, t.last);
        for (std::size_t i = 0; i < t.above.size(); ++i) at[t.extension + i] = Lanes<float>{};
        work.lower(t.first, t.last, bin);
    });
    for (const Index s : top_) work.read(s, s + 1);
    for (const Subtree& t : subtrees_) {
        for (std::size_t i = 0; i < t.above.size(); ++i) at[t.above[i]] += at[t.extension + i];
    }
    for (const Index s : top_) work.lower(s, s + 1, own_bin);
    for (auto s = top_.rbegin(); s != top_.rend(); ++s) work.upper(*s, *s + 1, own_bin);
    for (const Index s : top_) work.write(s, s + 1);
    for_each_bin(context, [&](const Subtree& t, Index bin) {
        for (std::size_t i = 0; i < t.above.size(); ++i) at[t.extension + i] = at[t.above[i]];
        work.upper(t.first, t.last, bin);
        work.write(t.first, t.last);
    });
}

}  // namespace lissom
