#include "kernel/merge/piece/face_set.h"

#include <algorithm>
#include <unordered_map>

#include "kernel/core/error.h"
#include "kernel/merge/loop/face_angles.h"

namespace lissom {

FaceSet::FaceSet(const Topology& topology, std::span<const Index> faces)
    : topology_(&topology), inside_(at(topology.face_count()), 0) {
    for (const Index f : faces) add(f);
}

std::vector<Index> FaceSet::faces() const {
    std::vector<Index> result;
    for (Index f = 0; f < topology_->face_count(); ++f) {
        if (contains(f)) result.push_back(f);
    }
    return result;
}

void FaceSet::add(Index face) {
    size_ += contains(face) ? 0 : 1;
    inside_[at(face)] = 1;
}

void FaceSet::remove(Index face) {
    size_ -= contains(face) ? 1 : 0;
    inside_[at(face)] = 0;
}

template <typename Predicate>
std::vector<std::vector<Index>> FaceSet::connected(const Predicate& is_member) const {
    std::vector<std::vector<Index>> parts;
    std::vector<char> seen(inside_.size(), 0);
    const auto reach = [&](Index f, std::vector<Index>& part) {
        if (f == kNoIndex || seen[at(f)] || !is_member(f)) return;
        seen[at(f)] = 1;
        part.push_back(f);
    };
    for (Index start = 0; start < topology_->face_count(); ++start) {
        std::vector<Index> part;
        reach(start, part);
        for (std::size_t i = 0; i < part.size(); ++i) {
            const std::span<const Index> face = topology_->face(part[i]);
            for (std::size_t k = 0; k < face.size(); ++k) {
                reach(face_left_of(*topology_, face[(k + 1) % face.size()], face[k]), part);
            }
        }
        if (part.empty()) continue;
        std::sort(part.begin(), part.end());
        parts.push_back(std::move(part));
    }
    std::stable_sort(parts.begin(), parts.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
    return parts;
}

std::vector<std::vector<Index>> FaceSet::parts() const {
    return connected([this](Index f) { return contains(f); });
}

std::vector<std::vector<Index>> FaceSet::outside_parts(const FaceSet* bounds) const {
    return connected([&](Index f) { return !contains(f) && (!bounds || bounds->contains(f)); });
}

bool FaceSet::is_bow_tie(Index vertex) const {
    const std::span<const Index> fan = topology_->faces_around(vertex);
    const bool open = topology_->is_boundary(vertex);
    Index starts = 0;
    for (std::size_t i = 0; i < fan.size(); ++i) {
        const bool first = i == 0 && open;
        const Index before = fan[(i + fan.size() - 1) % fan.size()];
        if (contains(fan[i]) && (first || !contains(before))) ++starts;
    }
    return starts > 1;
}

void FaceSet::grow_at_bow_ties(const FaceSet* bounds) {
    std::vector<char> touched(at(topology_->vertex_count()), 0);
    const auto touch = [&](Index f) {
        for (const Index v : topology_->face(f)) touched[at(v)] = 1;
    };
    for (Index f = 0; f < topology_->face_count(); ++f) {
        if (contains(f)) touch(f);
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (Index v = 0; v < topology_->vertex_count(); ++v) {
            if (!touched[at(v)] || !is_bow_tie(v)) continue;
            for (const Index f : topology_->faces_around(v)) {
                if (contains(f) || (bounds && !bounds->contains(f))) continue;
                add(f);
                touch(f);
                changed = true;
            }
        }
    }
}

std::vector<std::vector<Index>> FaceSet::loops() const {
    std::unordered_map<Index, Index> next;
    std::vector<Index> starts;
    for (Index f = 0; f < topology_->face_count(); ++f) {
        if (!contains(f)) continue;
        const std::span<const Index> face = topology_->face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Index a = face[k], b = face[(k + 1) % face.size()];
            const Index other = face_left_of(*topology_, b, a);
            if (other != kNoIndex && contains(other)) continue;
            next[a] = b;
            starts.push_back(a);
        }
    }
    std::sort(starts.begin(), starts.end());
    std::vector<std::vector<Index>> loops;
    for (const Index start : starts) {
        std::vector<Index> loop;
        for (auto step = next.find(start); step != next.end(); step = next.find(loop.back())) {
            if (loop.empty()) loop.push_back(start);
            const Index to = step->second;
            next.erase(step);
            if (to == start) break;
            loop.push_back(to);
        }
        if (!loop.empty()) loops.push_back(std::move(loop));
    }
    std::stable_sort(loops.begin(), loops.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
    return loops;
}

Index FaceSet::euler_characteristic() const {
    std::vector<char> seen(at(topology_->vertex_count()), 0);
    Index vertices = 0, doubled_edges = 0;
    for (Index f = 0; f < topology_->face_count(); ++f) {
        if (!contains(f)) continue;
        const std::span<const Index> face = topology_->face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
            vertices += seen[at(face[k])] ? 0 : 1;
            seen[at(face[k])] = 1;
            const Index other = face_left_of(*topology_, face[(k + 1) % face.size()], face[k]);
            doubled_edges += other != kNoIndex && contains(other) ? 1 : 2;
        }
    }
    return vertices - doubled_edges / 2 + size_;
}

}  // namespace lissom
