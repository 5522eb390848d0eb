#include "kernel/io/usda/strand_skin.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/hair/follow/strand_roots.h"

namespace lissom {
namespace {

[[noreturn]] void refuse_strands(const std::string& message, Elements strands = {}) {
    throw Error(ErrorCode::invalid_argument, message, std::move(strands));
}

// Refuses the strands, if there are any, by their numbers and this text.
void refuse_those(const Elements& strands, const char* text) {
    if (strands.count > 0) refuse_strands(describe(strands) + text, strands);
}

// Names and parents alone say which joint is meant.
using JointKey = std::pair<std::vector<std::string>, std::vector<Index>>;

// The skeleton of the objects that have roots.
Skeleton skeleton_at_roots(const Strands& strands, const Mesh& head) {
    const auto* asset = dynamic_cast<const SkinnedAsset*>(head.asset().get());
    if (!asset) return {};
    const auto& labels = head.attributes().labels();
    const auto objects = labels.find("object");
    std::set<Index> seen;
    std::map<JointKey, Skeleton> found;
    for (const Index face : strands.roots().faces) {
        if (face < 0 || face >= head.face_count()) continue;
        const Index label = objects == labels.end() ? kNoIndex : objects->second.of_face[at(face)];
        if (!seen.insert(label).second) continue;
        const std::string name = label == kNoIndex ? "" : objects->second.names[at(label)];
        Skeleton skeleton = asset->skeleton_of(name);
        found.emplace(JointKey(skeleton.names, skeleton.parents), std::move(skeleton));
    }
    if (found.size() > 1)
        throw Error(
            ErrorCode::skin_mismatch,
            "the hair is rooted on objects of unlike skins; save the hair of each by itself");
    return found.empty() ? Skeleton{} : std::move(found.begin()->second);
}

// Weights by joint of the skin's vertices.
class SkinWeights {
  public:
    explicit SkinWeights(const Mesh& head)
        : joints_(head.attributes().find("joints")), weights_(head.attributes().find("weights")) {
        const bool sound = joints_ && weights_ && joints_->width == weights_->width &&
                           joints_->domain == Domain::vertex && weights_->domain == Domain::vertex;
        if (!sound) joints_ = nullptr;
    }

    bool empty() const { return !joints_; }

    // Adds those of a vertex, which sum to 1, times `share`.
    void add(Index vertex, double share, Index joint_count, std::map<Index, double>& sums) const {
        const auto joints = joints_->at(vertex);
        const auto weights = weights_->at(vertex);
        double total = 0.0;
        for (const double w : weights) total += w > 0.0 ? w : 0.0;
        if (!(total > 0.0)) return;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            const bool counts = weights[i] > 0.0 && joints[i] >= 0.0 && joints[i] < joint_count;
            if (counts) sums[static_cast<Index>(joints[i])] += share * weights[i] / total;
        }
    }

  private:
    const Attribute *joints_, *weights_;
};

// The strongest joints of the sums; false if there are none.
bool take_strongest(const std::map<Index, double>& sums,
                    std::array<StrandSkin::Joint, StrandSkin::kInfluences>& result) {
    std::vector<std::pair<double, Index>> order;
    for (const auto& [joint, sum] : sums) order.emplace_back(-sum, joint);
    std::sort(order.begin(), order.end());
    order.resize(std::min(order.size(), result.size()));
    double total = 0.0;
    for (const auto& entry : order) total -= entry.first;
    if (!(total > 0.0)) return false;
    for (std::size_t i = 0; i < order.size(); ++i) {
        result[i] = {order[i].second, static_cast<float>(-order[i].first / total)};
    }
    return true;
}

// The joints in an order in which parents come first, as USD asks.
std::vector<Index> parents_first(const Skeleton& skeleton) {
    const auto depth = [&](Index joint) {
        std::size_t steps = 0;
        for (; joint != kNoIndex && steps <= skeleton.parents.size(); ++steps) {
            joint = skeleton.parents[at(joint)];
        }
        return steps;
    };
    std::vector<std::pair<std::size_t, Index>> order;
    for (Index j = 0; j < count_of(skeleton.names); ++j) order.emplace_back(depth(j), j);
    std::sort(order.begin(), order.end());
    std::vector<Index> result;
    for (const auto& entry : order) result.push_back(entry.second);
    return result;
}

// Puts the joints into this order, and the joints of strands with them.
void reorder(StrandSkin& skin, const std::vector<Index>& order) {
    std::vector<Index> place(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) place[at(order[i])] = index_of(i);
    Skeleton sorted;
    for (const Index j : order) {
        const Index parent = skin.skeleton.parents[at(j)];
        sorted.names.push_back(skin.skeleton.names[at(j)]);
        sorted.parents.push_back(parent == kNoIndex ? kNoIndex : place[at(parent)]);
        sorted.bind.push_back(skin.skeleton.bind[at(j)]);
        sorted.rest.push_back(skin.skeleton.rest[at(j)]);
    }
    skin.skeleton = std::move(sorted);
    for (auto& joints : skin.of_strand) {
        for (StrandSkin::Joint& one : joints) one.joint = place[at(one.joint)];
    }
}

// A name that may stand in a path.
std::string identifier(const std::string& name) {
    std::string result;
    for (const char c : name) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
        const bool digit = c >= '0' && c <= '9';
        if (digit && result.empty()) result += '_';
        result += letter || digit ? c : '_';
    }
    return result.empty() ? "joint" : result;
}

}  // namespace

StrandSkin skin_at_roots(const Strands& strands, const Mesh& head, double unit,
                         const Context& context) {
    const SkinWeights weights(head);
    StrandSkin skin;
    if (!weights.empty()) skin.skeleton = skeleton_at_roots(strands, head);
    if (skin.skeleton.names.empty())
        refuse_strands(
            "the head has no skin, so that no joints can move the hair; give a head that was "
            "loaded from a .glb file with a skin, or leave out 'head'");
    skin.of_strand.resize(at(strands.size()));
    Elements rootless{ElementKind::strand, 0, {}}, bare{ElementKind::strand, 0, {}};
    std::map<Index, double> sums;
    Progress progress(context, "save strands");
    for (Index s = 0; s < strands.size(); ++s) {
        if (s % 4096 == 0) progress.update(double(s) / double(strands.size()));
        const auto triangle = root_triangle(strands.roots(), s, head);
        if (!triangle) {
            rootless.add(s);
            continue;
        }
        sums.clear();
        for (std::size_t c = 0; c < 3; ++c) {
            const float share = strands.roots().barycentrics[at(s)][static_cast<Index>(c)];
            weights.add((*triangle)[c], std::max(share, 0.0f), count_of(skin.skeleton.names), sums);
        }
        if (!take_strongest(sums, skin.of_strand[at(s)])) bare.add(s);
    }
    refuse_those(rootless,
                 ": no root on this head; give the head that the hair grew on, or move it there "
                 "with strands:transfer");
    refuse_those(bare,
                 ": roots on vertices without weights; give these vertices weights, or leave out "
                 "'head'");
    for (auto* transforms : {&skin.skeleton.bind, &skin.skeleton.rest}) {
        for (Affine& transform : *transforms) transform.translation *= unit;
    }
    reorder(skin, parents_first(skin.skeleton));
    return skin;
}

std::vector<std::string> joint_paths(const Skeleton& skeleton) {
    std::vector<std::string> paths;
    std::set<std::string> taken;
    for (std::size_t j = 0; j < skeleton.names.size(); ++j) {
        const Index parent = skeleton.parents[j];
        const std::string path =
            (parent == kNoIndex ? "" : paths[at(parent)] + "/") + identifier(skeleton.names[j]);
        std::string unique = path;
        for (int i = 2; !taken.insert(unique).second; ++i) unique = path + "_" + std::to_string(i);
        paths.push_back(unique);
    }
    return paths;
}

}  // namespace lissom
