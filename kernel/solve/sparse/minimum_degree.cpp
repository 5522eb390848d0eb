#include "kernel/solve/sparse/minimum_degree.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace lissom {
namespace {

// Unknowns with more neighbors than this times the square root of their number come last.
constexpr double kDenseFactor = 10.0;
constexpr Index kMinDense = 16;

// Pivots between two looks for a cancel.
constexpr Index kPivotsPerCheckpoint = 1024;

// Integers per unknown, of the arrays below and of the assembly tree.
constexpr std::size_t kArrays = 14;

// The quotient graph. A number stands for a variable (one unknown or several that cannot be told
// apart, the supervariable) until it is chosen as a pivot, and then for an element: the clique of
// the variables that its elimination has joined. The list of a variable names elements first, then
// variables; that of an element, variables.
class QuotientGraph {
  public:
    explicit QuotientGraph(const Adjacency& graph);

    void eliminate_all(const Context& context);
    std::vector<Index> order() const;

  private:
    void sort_by_degree();
    void link(Index i, Index degree);
    void unlink(Index i);

    Index take_pivot();
    void make_room(Index entries);
    void form_element(Index pivot);
    void join(Index pivot, Index begin, Index count, Index& end);
    void measure_overlaps(Index pivot);
    void shorten_list(Index i, Index pivot);
    void update_degrees(Index pivot);
    void merge_variables(Index pivot);
    void merge_bucket(Index first);
    bool same_list(Index i, Index j) const;
    void close_element(Index pivot);
    void absorb_element(Index element, Index into);
    void absorb_variable(Index variable, Index into);
    void next_mark(Index span);

    std::vector<Index> assembly_order() const;

    Index size_;
    // Lists: of i, list_[start_[i]] and the length_[i] - 1 after it, elements_[i] of them elements.
    std::vector<Index> list_, start_, length_, elements_;
    // Number of unknowns represented by a variable or pivot; 0 if another represents them, negative
    // for a variable while it is in the list of the current pivot.
    std::vector<Index> weight_;
    // For a variable, a bound of its unknowns' degree; for an element, the unknowns in its list.
    std::vector<Index> degree_;
    // Variables by degree, doubly linked; by hash, linked by next_, with the hash in last_.
    std::vector<Index> head_, bucket_, next_, last_;
    // Absorber of an element or a variable.
    std::vector<Index> parent_;
    // 0 for an element that is gone; see measure_overlaps and merge_bucket.
    std::vector<Index> mark_;
    Index current_ = 2, widest_ = 0;
    Index end_ = 0, min_degree_ = 0, eliminated_ = 0;
};

QuotientGraph::QuotientGraph(const Adjacency& graph)
    : size_(graph.size()),
      list_(minimum_degree_room(at(size_), graph.neighbor.size())),
      start_(graph.begin.begin(), graph.begin.end() - 1),
      length_(at(size_)),
      elements_(at(size_), 0),
      weight_(at(size_), 1),
      degree_(at(size_)),
      head_(at(size_), kNoIndex),
      bucket_(at(size_), kNoIndex),
      next_(at(size_), kNoIndex),
      last_(at(size_), kNoIndex),
      parent_(at(size_), kNoIndex),
      mark_(at(size_), 1),
      end_(count_of(graph.neighbor)) {
    std::copy(graph.neighbor.begin(), graph.neighbor.end(), list_.begin());
    for (Index i = 0; i < size_; ++i) length_[i] = degree_[i] = graph.degree(i);
    sort_by_degree();
}

// Unknowns without neighbors are eliminated at once, those with too many are left out.
void QuotientGraph::sort_by_degree() {
    const double bound = std::max<double>(kMinDense, kDenseFactor * std::sqrt(size_));
    const Index dense = static_cast<Index>(std::min<double>(size_, bound));
    for (Index i = 0; i < size_; ++i) {
        if (degree_[i] == 0) {
            mark_[i] = 0;
            start_[i] = kNoIndex;
            ++eliminated_;
        } else if (degree_[i] > dense) {
            weight_[i] = 0;
            start_[i] = kNoIndex;
            ++eliminated_;
        } else {
            link(i, degree_[i]);
        }
    }
}

void QuotientGraph::link(Index i, Index degree) {
    const Index first = head_[degree];
    if (first != kNoIndex) last_[first] = i;
    next_[i] = first;
    last_[i] = kNoIndex;
    head_[degree] = i;
}

void QuotientGraph::unlink(Index i) {
    const Index before = last_[i], after = next_[i];
    if (after != kNoIndex) last_[after] = before;
    if (before != kNoIndex) {
        next_[before] = after;
    } else {
        head_[degree_[i]] = after;
    }
}

Index QuotientGraph::take_pivot() {
    while (head_[min_degree_] == kNoIndex) ++min_degree_;
    const Index pivot = head_[min_degree_];
    unlink(pivot);
    eliminated_ += weight_[pivot];
    return pivot;
}

// Moves the lists together if fewer than `entries` are left behind them. Meanwhile the first entry
// of each list waits in start_, and its place names the owner, so that lists are found in their
// order.
void QuotientGraph::make_room(Index entries) {
    if (count_of(list_) - end_ >= entries) return;
    for (Index i = 0; i < size_; ++i) {
        if (start_[i] == kNoIndex || length_[i] == 0) continue;
        Index& first = list_[start_[i]];
        start_[i] = std::exchange(first, -1 - i);
    }
    Index to = 0;
    for (Index from = 0; from < end_;) {
        if (list_[from] >= 0) {
            ++from;
            continue;
        }
        const Index owner = -1 - list_[from], length = length_[owner];
        list_[to] = std::exchange(start_[owner], to);
        std::copy(list_.begin() + from + 1, list_.begin() + from + length, list_.begin() + to + 1);
        to += length;
        from += length;
    }
    end_ = to;
}

// Appends the variables in `count` entries from `begin` on to the list of the pivot, each once.
void QuotientGraph::join(Index pivot, Index begin, Index count, Index& end) {
    for (Index k = begin; k < begin + count; ++k) {
        const Index i = list_[k], weight = weight_[i];
        if (weight <= 0) continue;
        degree_[pivot] += weight;
        weight_[i] = -weight;
        list_[end++] = i;
        unlink(i);
    }
}

// The pivot becomes an element. Its list is the union of those of its elements and of its own. Its
// degree bounds the length.
void QuotientGraph::form_element(Index pivot) {
    const Index elements = elements_[pivot];
    if (elements > 0) make_room(degree_[pivot]);
    const Index begin = start_[pivot], length = length_[pivot];
    weight_[pivot] = -weight_[pivot];
    degree_[pivot] = 0;
    Index own_end = begin;
    Index& end = elements > 0 ? end_ : own_end;
    start_[pivot] = end;
    for (Index k = begin; k < begin + elements; ++k) {
        const Index e = list_[k];
        join(pivot, start_[e], length_[e], end);
        absorb_element(e, pivot);
    }
    join(pivot, begin + elements, length - elements, end);
    length_[pivot] = end - start_[pivot];
}

void QuotientGraph::absorb_element(Index element, Index into) {
    parent_[element] = into;
    start_[element] = kNoIndex;
    mark_[element] = 0;
}

void QuotientGraph::absorb_variable(Index variable, Index into) {
    parent_[variable] = into;
    start_[variable] = kNoIndex;
    weight_[variable] = 0;
}

// Marks up to `span` above the current one may be in use: takes one that is greater than all.
void QuotientGraph::next_mark(Index span) {
    if (current_ < std::numeric_limits<Index>::max() - 2 * size_ - span) {
        current_ += span;
        return;
    }
    for (Index& mark : mark_) mark = mark != 0 ? 1 : 0;
    current_ = 2;
}

// mark_[e] - current_ becomes the number of unknowns of e that are not in the pivot's list, for
// every element e that has any there.
void QuotientGraph::measure_overlaps(Index pivot) {
    const Index begin = start_[pivot], end = begin + length_[pivot];
    for (Index k = begin; k < end; ++k) {
        const Index i = list_[k], weight = -weight_[i];
        const Index first = start_[i], last = first + elements_[i];
        for (Index p = first; p < last; ++p) {
            const Index e = list_[p];
            Index& mark = mark_[e];
            if (mark >= current_) {
                mark -= weight;
            } else if (mark != 0) {
                mark = current_ + degree_[e] - weight;
            }
        }
    }
}

// Rewrites the list of a variable of the pivot's list: the pivot, the elements that reach beyond
// it, the variables outside it. Bounds the degree without the pivot's part. A variable without any
// but the pivot is eliminated with it. Others go into the buckets of equal hashes.
void QuotientGraph::shorten_list(Index i, Index pivot) {
    const Index begin = start_[i], elements_end = begin + elements_[i], end = begin + length_[i];
    Index to = begin, degree = 0;
    std::uint32_t hash = 0;
    for (Index p = begin; p < elements_end; ++p) {
        const Index e = list_[p], mark = mark_[e];
        if (mark == 0) continue;
        if (mark == current_) {
            absorb_element(e, pivot);
            continue;
        }
        degree += mark - current_;
        list_[to++] = e;
        hash += static_cast<std::uint32_t>(e);
    }
    const Index variables = to;
    for (Index p = elements_end; p < end; ++p) {
        const Index j = list_[p], weight = weight_[j];
        if (weight <= 0) continue;
        degree += weight;
        list_[to++] = j;
        hash += static_cast<std::uint32_t>(j);
    }
    if (to == begin) {
        const Index weight = -weight_[i];
        degree_[pivot] -= weight;
        weight_[pivot] -= weight;
        eliminated_ += weight;
        absorb_variable(i, pivot);
        return;
    }
    degree_[i] = std::min(degree_[i], degree);
    list_[to] = list_[variables];
    list_[variables] = list_[begin];
    list_[begin] = pivot;
    elements_[i] = variables - begin + 1;
    length_[i] = to - begin + 1;
    last_[i] = static_cast<Index>(hash % static_cast<std::uint32_t>(size_));
    next_[i] = std::exchange(bucket_[last_[i]], i);
}

void QuotientGraph::update_degrees(Index pivot) {
    const Index begin = start_[pivot], end = begin + length_[pivot];
    for (Index k = begin; k < end; ++k) shorten_list(list_[k], pivot);
    widest_ = std::max(widest_, degree_[pivot]);
    next_mark(widest_);
}

// Variables of the pivot's list that have the same list become one.
void QuotientGraph::merge_variables(Index pivot) {
    const Index begin = start_[pivot], end = begin + length_[pivot];
    for (Index k = begin; k < end; ++k) {
        const Index i = list_[k];
        if (weight_[i] < 0) merge_bucket(std::exchange(bucket_[last_[i]], kNoIndex));
    }
}

void QuotientGraph::merge_bucket(Index first) {
    for (Index i = first; i != kNoIndex && next_[i] != kNoIndex; i = next_[i]) {
        const Index begin = start_[i] + 1, end = start_[i] + length_[i];
        for (Index p = begin; p < end; ++p) mark_[list_[p]] = current_;
        Index before = i;
        for (Index j = next_[i]; j != kNoIndex; j = next_[before]) {
            if (!same_list(i, j)) {
                before = j;
                continue;
            }
            weight_[i] += weight_[j];
            absorb_variable(j, i);
            next_[before] = next_[j];
        }
        ++current_;
    }
}

// Returns whether j has the list of i. The entries of i are marked. All begin with the pivot.
bool QuotientGraph::same_list(Index i, Index j) const {
    if (length_[i] != length_[j] || elements_[i] != elements_[j]) return false;
    const auto begin = list_.begin() + start_[j];
    return std::all_of(begin + 1, begin + length_[j],
                       [&](Index k) { return mark_[k] == current_; });
}

// Leaves the variables in the pivot's list and puts them back among the degrees.
void QuotientGraph::close_element(Index pivot) {
    const Index begin = start_[pivot], end = begin + length_[pivot], left = size_ - eliminated_;
    const bool is_last = end == end_;
    Index to = begin;
    for (Index k = begin; k < end; ++k) {
        const Index i = list_[k], weight = -weight_[i];
        if (weight <= 0) continue;
        weight_[i] = weight;
        degree_[i] = std::min(degree_[i] + degree_[pivot] - weight, left - weight);
        link(i, degree_[i]);
        min_degree_ = std::min(min_degree_, degree_[i]);
        list_[to++] = i;
    }
    weight_[pivot] = -weight_[pivot];
    length_[pivot] = to - begin;
    if (is_last) end_ = to;
    if (to > begin) return;
    start_[pivot] = kNoIndex;
    mark_[pivot] = 0;
}

void QuotientGraph::eliminate_all(const Context& context) {
    for (Index pivots = 0; eliminated_ < size_; ++pivots) {
        if (pivots % kPivotsPerCheckpoint == 0) context.checkpoint();
        const Index pivot = take_pivot();
        form_element(pivot);
        measure_overlaps(pivot);
        update_degrees(pivot);
        merge_variables(pivot);
        close_element(pivot);
    }
}

// Returns the elements, each after the ones it absorbed, the greatest of these last.
std::vector<Index> QuotientGraph::assembly_order() const {
    std::vector<Index> child(at(size_), kNoIndex), sibling(at(size_), kNoIndex);
    const auto front = [&](Index e) { return weight_[e] + degree_[e]; };
    for (Index e = size_; e-- > 0;) {
        if (weight_[e] > 0 && parent_[e] != kNoIndex) {
            sibling[e] = std::exchange(child[parent_[e]], e);
        }
    }
    for (Index e = 0; e < size_; ++e) {
        Index* greatest = &child[e];
        Index* last = &child[e];
        for (; *last != kNoIndex; last = &sibling[*last]) {
            if (front(*last) >= front(*greatest)) greatest = last;
        }
        if (*greatest == kNoIndex || sibling[*greatest] == kNoIndex) continue;
        const Index moved = *greatest;
        *last = moved;
        *greatest = std::exchange(sibling[moved], kNoIndex);
    }
    std::vector<Index> order, path;
    order.reserve(at(size_));
    for (Index root = 0; root < size_; ++root) {
        if (weight_[root] <= 0 || parent_[root] != kNoIndex) continue;
        path.push_back(root);
        while (!path.empty()) {
            Index& next = child[path.back()];
            if (next == kNoIndex) {
                order.push_back(path.back());
                path.pop_back();
            } else {
                path.push_back(std::exchange(next, sibling[next]));
            }
        }
    }
    return order;
}

// Returns the unknowns of each pivot together, the pivot itself last; at the end the deferred ones.
std::vector<Index> QuotientGraph::order() const {
    std::vector<Index> place(at(size_)), result(at(size_));
    Index count = 0;
    for (const Index e : assembly_order()) {
        place[e] = count;
        count += weight_[e];
    }
    std::vector<Index> into = parent_;
    for (Index i = 0; i < size_; ++i) {
        if (weight_[i] > 0) continue;
        Index e = i;
        while (weight_[e] == 0 && into[e] != kNoIndex) e = into[e];
        for (Index k = i; k != e;) k = std::exchange(into[k], e);
        result[weight_[e] > 0 ? place[e]++ : count++] = i;
    }
    for (Index e = 0; e < size_; ++e) {
        if (weight_[e] > 0) result[place[e]] = e;
    }
    return result;
}

}  // namespace

std::size_t minimum_degree_room(std::size_t unknowns, std::size_t entries) {
    return entries + entries / 5 + unknowns;
}

std::size_t minimum_degree_bytes(std::size_t unknowns, std::size_t entries) {
    return (minimum_degree_room(unknowns, entries) + kArrays * unknowns) * sizeof(Index);
}

std::vector<Index> minimum_degree_order(const Adjacency& graph, const Context& context) {
    QuotientGraph quotient(graph);
    quotient.eliminate_all(context);
    return quotient.order();
}

}  // namespace lissom
