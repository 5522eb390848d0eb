#include "kernel/merge/sew/seam_skin.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "kernel/mesh/skinned_asset.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {
namespace {

// The joints and weights of a mesh, or null if it has no sound pair of them.
struct Skin {
    Attribute* joints = nullptr;
    Attribute* weights = nullptr;

    explicit Skin(AttributeSet& attributes)
        : joints(attributes.find("joints")), weights(attributes.find("weights")) {
        const bool sound = joints && weights && joints->width == weights->width &&
                           joints->domain == Domain::vertex && weights->domain == Domain::vertex;
        if (!sound) joints = weights = nullptr;
    }

    explicit operator bool() const { return joints != nullptr; }

    double total(Index v) const {
        double sum = 0.0;
        for (const double w : std::as_const(*weights).at(v)) sum += w > 0.0 ? w : 0.0;
        return sum;
    }
};

bool has_skin(const Mesh& mesh) {
    const Attribute* joints = mesh.attributes().find("joints");
    const Attribute* weights = mesh.attributes().find("weights");
    return joints && weights;
}

// The joints of the objects that have faces at a loop; more than one list if they differ.
std::set<std::vector<std::string>> joints_at(const Mesh& mesh, std::span<const Index> loop) {
    const auto* asset = dynamic_cast<const SkinnedAsset*>(mesh.asset().get());
    if (!asset) return {{}};
    const auto labels = mesh.attributes().labels().find("object");
    std::set<std::vector<std::string>> found;
    for (const Index v : loop) {
        for (const Index f : mesh.topology().faces_around(v)) {
            const Index label =
                labels == mesh.attributes().labels().end() ? kNoIndex : labels->second.of_face[f];
            found.insert(asset->joints_of(label == kNoIndex ? "" : labels->second.names[label]));
        }
    }
    return found;
}

// The weights of the joints at the seams, continued to the vertices that have none.
class SkinExtension {
  public:
    SkinExtension(Sewn& sewn, SeamSide skinned, const Context& context)
        : mesh_(sewn.mesh), context_(context), skin_(mesh_.attributes()) {
        std::vector<char> wanted(mesh_.vertex_count(), 0);
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            if (sewn.side_of_face[f] == skinned) continue;
            for (const Index v : mesh_.topology().face(f)) wanted[v] = 1;
        }
        find_unknowns(wanted);
    }

    void run() {
        if (unknowns_.empty()) return;
        std::vector<double> values = right_hand_sides();
        SparseSystem system;
        const SymmetricMatrix matrix = laplacian();
        system.analyze(matrix, context_);
        system.factor(matrix, context_);
        system.solve(values, values, count_of(joint_numbers_));
        for (std::size_t i = 0; i < unknowns_.size(); ++i) write(i, values);
    }

  private:
    // Wanted vertices without weights that edges through such vertices join to one with weights.
    // The others get none.
    void find_unknowns(const std::vector<char>& wanted) {
        row_.assign(mesh_.vertex_count(), kNoIndex);
        const auto is_open = [&](Index v) { return wanted[v] && !(skin_.total(v) > 0.0); };
        const auto add = [&](Index v) {
            if (!is_open(v) || row_[v] != kNoIndex) return;
            row_[v] = count_of(unknowns_);
            unknowns_.push_back(v);
        };
        for (Index v = 0; v < mesh_.vertex_count(); ++v) {
            if (!(skin_.total(v) > 0.0)) continue;
            for (const Index w : mesh_.topology().neighbors(v)) add(w);
        }
        for (std::size_t i = 0; i < unknowns_.size(); ++i) {
            for (const Index w : mesh_.topology().neighbors(unknowns_[i])) add(w);
        }
        for (Index v = 0; v < mesh_.vertex_count(); ++v) {
            if (!is_open(v)) continue;
            std::fill(skin_.joints->at(v).begin(), skin_.joints->at(v).end(), 0.0);
            std::fill(skin_.weights->at(v).begin(), skin_.weights->at(v).end(), 0.0);
        }
    }

    bool is_known(Index v) const { return row_[v] == kNoIndex && skin_.total(v) > 0.0; }

    // Positive, so that the result stays between the values at the seam.
    double edge_weight(Index v, Index w) const {
        const double length = (mesh_.position(v) - mesh_.position(w)).norm();
        return length > 0.0 ? 1.0 / length : 0.0;
    }

    SymmetricMatrix laplacian() const {
        std::vector<Triplet> entries;
        for (const Index v : unknowns_) {
            for (const Index w : mesh_.topology().neighbors(v)) {
                const double weight = is_known(w) || row_[w] != kNoIndex ? edge_weight(v, w) : 0.0;
                entries.push_back({row_[v], row_[v], weight});
                if (row_[w] != kNoIndex) entries.push_back({row_[v], row_[w], -weight});
            }
        }
        return symmetric_from_triplets(count_of(unknowns_), entries);
    }

    std::vector<double> right_hand_sides() {
        std::map<double, std::vector<std::pair<Index, double>>> entries;
        for (const Index v : unknowns_) {
            for (const Index w : mesh_.topology().neighbors(v)) {
                const double total = row_[w] == kNoIndex ? skin_.total(w) : 0.0;
                if (!(total > 0.0)) continue;
                for (Index k = 0; k < skin_.joints->width; ++k) {
                    const double weight = skin_.weights->at(w)[k];
                    if (!(weight > 0.0)) continue;
                    entries[skin_.joints->at(w)[k]].push_back(
                        {row_[v], edge_weight(v, w) * weight / total});
                }
            }
        }
        std::vector<double> values(entries.size() * unknowns_.size(), 0.0);
        for (const auto& [joint, parts] : entries) {
            const std::size_t column = joint_numbers_.size() * unknowns_.size();
            for (const auto& [row, value] : parts) values[column + row] += value;
            joint_numbers_.push_back(joint);
        }
        return values;
    }

    // The strongest joints that there is room for.
    void write(std::size_t i, const std::vector<double>& values) {
        std::vector<std::pair<double, double>> order;
        for (std::size_t j = 0; j < joint_numbers_.size(); ++j) {
            order.emplace_back(-std::max(0.0, values[j * unknowns_.size() + i]), joint_numbers_[j]);
        }
        std::sort(order.begin(), order.end());
        const std::span<double> joints = skin_.joints->at(unknowns_[i]);
        const std::span<double> weights = skin_.weights->at(unknowns_[i]);
        order.resize(std::min(order.size(), joints.size()));
        double sum = 0.0;
        for (const auto& [weight, joint] : order) sum -= weight;
        std::fill(joints.begin(), joints.end(), 0.0);
        std::fill(weights.begin(), weights.end(), 0.0);
        for (std::size_t k = 0; k < order.size() && order[k].first < 0.0; ++k) {
            joints[k] = order[k].second;
            weights[k] = -order[k].first / sum;
        }
    }

    Mesh& mesh_;
    const Context& context_;
    Skin skin_;
    std::vector<Index> unknowns_, row_;
    std::vector<double> joint_numbers_;
};

// Gives the faces of the other side the object of the skinned side at the first seam, so that one
// skin moves both.
void join_objects(Sewn& sewn, SeamSide skinned) {
    const auto labels = sewn.mesh.attributes().labels().find("object");
    const auto* asset = dynamic_cast<const SkinnedAsset*>(sewn.mesh.asset().get());
    if (!asset || labels == sewn.mesh.attributes().labels().end()) return;
    std::vector<Index>& of_face = labels->second.of_face;
    Index object = kNoIndex;
    for (const Index f : sewn.mesh.topology().faces_around(sewn.seams[0][0])) {
        if (sewn.side_of_face[f] == skinned) object = of_face[f];
    }
    for (std::size_t f = 0; f < of_face.size(); ++f) {
        if (sewn.side_of_face[f] != skinned) of_face[f] = object;
    }
}

}  // namespace

void require_same_joints(const Mesh& target, const Mesh& source, std::span<const LoopPair> joins) {
    if (!has_skin(target) || !has_skin(source)) return;
    for (const LoopPair& join : joins) {
        std::set<std::vector<std::string>> joints = joints_at(target, join.target);
        joints.merge(joints_at(source, join.source));
        const bool known = joints.size() == 1;
        const bool same_numbers = !joints.begin()->empty() || target.asset() == source.asset();
        if (known && same_numbers) continue;
        Elements elements{ElementKind::vertex, 0, {}};
        for (const Index v : join.target) elements.add(v);
        throw Error(ErrorCode::skin_mismatch,
                    "the two sides of a join are moved by different joints; give both the same "
                    "joints in the same order, or remove \"joints\" and \"weights\" of one side",
                    elements);
    }
}

std::optional<SeamSide> skinned_side(const Mesh& target, const Mesh& source) {
    if (has_skin(target) == has_skin(source)) return std::nullopt;
    return has_skin(target) ? SeamSide::target : SeamSide::source;
}

void extend_skin(Sewn& sewn, SeamSide skinned, const Context& context) {
    if (!Skin(sewn.mesh.attributes())) return;
    SkinExtension(sewn, skinned, context).run();
    join_objects(sewn, skinned);
}

}  // namespace lissom
