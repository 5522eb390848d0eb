#include "kernel/io/poses/pose_targets.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/numbers/number_text.h"
#include "kernel/io/gltf/animation.h"
#include "kernel/io/gltf/mesh/names.h"
#include "kernel/mesh/measure/measures.h"
#include "kernel/mesh/morph_asset.h"

namespace lissom {
namespace {

using NamedWeights = std::map<std::string, double>;

constexpr int kSampleSteps = 10;

// Rows of correctives are dependent if a pivot is smaller.
constexpr double kLeastPivot = 1e-9;

NamedWeights summed(const std::vector<PoseWeight>& weights) {
    NamedWeights sums;
    for (const PoseWeight& given : weights) sums[given.name] += given.weight;
    std::erase_if(sums, [](const auto& entry) { return entry.second == 0.0; });
    return sums;
}

std::vector<PoseWeight> listed(const NamedWeights& weights) {
    std::vector<PoseWeight> list;
    for (const auto& [name, weight] : weights) list.push_back({name, weight});
    return list;
}

double weight_in(const NamedWeights& weights, const std::string& name) {
    const auto found = weights.find(name);
    return found == weights.end() ? 0.0 : found->second;
}

// 1 at `peak` and 0 at rest; if the peak is not the pose, 0 there as well.
double hat(double weight, double peak) {
    const bool within = peak > 0.0 && peak < 1.0;
    const bool from_pose = peak > 1.0 || (within && weight > peak);
    return std::max(from_pose ? (weight - 1.0) / (peak - 1.0) : weight / peak, 0.0);
}

double drive(const PoseTarget& target, const NamedWeights& weights) {
    if (!target.is_corrective) return weight_in(weights, target.name);
    double product = 1.0;
    for (const PoseWeight& peak : target.at) {
        product *= hat(weight_in(weights, peak.name), peak.weight);
    }
    return product;
}

std::string text_of(double number) {
    std::array<char, 32> text{};
    const auto end = write_number(text.data(), text.data() + text.size(), number).ptr;
    return {text.data(), end};
}

std::string corrective_name(const NamedWeights& at) {
    std::string name;
    for (const auto& [pose, weight] : at) {
        name += (name.empty() ? "" : ",") + pose + "=" + text_of(weight);
    }
    return name;
}

// Positions, and normals if they are wanted, of a shape.
struct TargetShape {
    std::vector<Vec3> positions, normals;
};

TargetShape operator-(TargetShape a, const TargetShape& b) {
    for (std::size_t v = 0; v < a.positions.size(); ++v) a.positions[v] -= b.positions[v];
    for (std::size_t v = 0; v < a.normals.size(); ++v) a.normals[v] -= b.normals[v];
    return a;
}

void add_scaled(TargetShape& sum, double factor, const TargetShape& shape) {
    if (factor == 0.0) return;
    for (std::size_t v = 0; v < sum.positions.size(); ++v) {
        sum.positions[v] += factor * shape.positions[v];
    }
    for (std::size_t v = 0; v < sum.normals.size(); ++v) {
        sum.normals[v] += factor * shape.normals[v];
    }
}

class TargetMaker {
  public:
    TargetMaker(const PoseSpace& space, const PoseTargetOptions& options, const Context& context)
        : space_(space), context_(context), rest_(space.rest()) {
        require(rest_.face_count() > 0, "a mesh without faces has no morph targets",
                ErrorCode::unsupported);
        drop_morphs();
        const Attribute* normals = rest_.attributes().find("normal");
        has_normals_ = normals && normals->domain == Domain::vertex && normals->width == 3;
        makes_normals_ = options.normals && !normals;
        rest_shape_ = shape_of(rest_);
        if (makes_normals_) add_normals();
        for (const std::string& name : space.names()) targets_.push_back({name, {{name, 1.0}}});
        pose_count_ = targets_.size();
        add_path_correctives();
        for (const auto& at : options.correctives) add_corrective(summed(at));
    }

    Mesh make(PoseTargetReport* report) {
        for (std::size_t t = 0; t < pose_count_; ++t) {
            changes_.push_back(shape_at(summed(targets_[t].at)) - rest_shape_);
        }
        find_correctives();
        for (std::size_t t = 0; t < targets_.size(); ++t) write(index_of(t));
        name_targets();
        if (report) measure(*report);
        return std::move(rest_);
    }

  private:
    void drop_morphs() {
        std::vector<std::string> names;
        for (const Attribute& attribute : rest_.attributes().all()) {
            if (parse_morph_name(attribute.name).target > 0) names.push_back(attribute.name);
        }
        for (const std::string& name : names) rest_.attributes().remove(name);
        if (names.empty()) return;
        context_.log(LogLevel::warning,
                     "the morph targets that the rest shape had, and their animations, are left "
                     "out");
    }

    TargetShape shape_of(const Mesh& mesh) const {
        TargetShape shape{{mesh.positions().begin(), mesh.positions().end()}, {}};
        if (makes_normals_) shape.normals = vertex_normals(mesh);
        if (!has_normals_) return shape;
        const Attribute& normals = *mesh.attributes().find("normal");
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            shape.normals.emplace_back(normals.at(v)[0], normals.at(v)[1], normals.at(v)[2]);
        }
        return shape;
    }

    void add_normals() {
        std::vector<double> numbers;
        for (const Vec3& n : rest_shape_.normals) numbers.insert(numbers.end(), n.begin(), n.end());
        rest_.attributes().add(
            {"normal", Domain::vertex, 3, ScalarType::float32, std::move(numbers)});
    }

    TargetShape shape_at(const NamedWeights& weights) const {
        return shape_of(space_.blend(listed(weights), context_));
    }

    // The poses' targets with weights, and the correctives so far.
    TargetShape sum_at(const NamedWeights& weights, std::size_t count) const {
        TargetShape sum = rest_shape_;
        for (std::size_t t = 0; t < count; ++t) {
            add_scaled(sum, drive(targets_[t], weights), changes_[t]);
        }
        return sum;
    }

    void add_path_correctives() {
        for (std::size_t p = 0; p < pose_count_; ++p) {
            const Index shapes = space_.shape_count(targets_[p].name);
            for (Index k = 1; k < shapes; ++k) {
                add_corrective({{targets_[p].name, static_cast<double>(k) / shapes}});
            }
        }
    }

    void add_corrective(const NamedWeights& at) {
        require(!at.empty(), "a corrective needs a weight other than 0");
        const std::string name = corrective_name(at);
        require(at.size() > 1 || at.begin()->second != 1.0,
                "a corrective at '" + name + "' corrects nothing: the pose alone is exact");
        for (const PoseTarget& target : targets_) {
            require(!target.is_corrective || target.name != name,
                    "there are two correctives at '" + name + "'");
        }
        targets_.push_back({name, listed(at), true});
    }

    // All correctives together take back the errors at the weights of each.
    void find_correctives() {
        const std::size_t count = targets_.size() - pose_count_;
        if (count == 0) return;
        Eigen::MatrixXd drives(count, count);
        std::vector<TargetShape> errors;
        for (std::size_t i = 0; i < count; ++i) {
            const NamedWeights at = summed(targets_[pose_count_ + i].at);
            errors.push_back(shape_at(at) - sum_at(at, pose_count_));
            for (std::size_t k = 0; k < count; ++k) {
                drives(index_of(i), index_of(k)) = drive(targets_[pose_count_ + k], at);
            }
        }
        const Eigen::FullPivLU<Eigen::MatrixXd> factor(drives);
        require(std::abs(factor.matrixLU().diagonal()[index_of(count) - 1]) > kLeastPivot,
                "correctives cannot be told apart; leave out some that lie between others");
        const Eigen::MatrixXd inverse = factor.inverse();
        for (std::size_t i = 0; i < count; ++i) {
            TargetShape change = rest_shape_ - rest_shape_;
            for (std::size_t k = 0; k < count; ++k) {
                add_scaled(change, inverse(index_of(i), index_of(k)), errors[k]);
            }
            changes_.push_back(std::move(change));
        }
    }

    void write(Index target) {
        const TargetShape& change = changes_[at(target)];
        write(target, GltfSemantic::position, change.positions);
        if (!change.normals.empty()) write(target, GltfSemantic::normal, change.normals);
    }

    void write(Index target, GltfSemantic semantic, const std::vector<Vec3>& values) {
        std::vector<double> numbers;
        for (const Vec3& value : values) numbers.insert(numbers.end(), value.begin(), value.end());
        rest_.attributes().add({morph_name(target + 1, semantic), Domain::vertex, 3,
                                ScalarType::float32, std::move(numbers)});
    }

    void name_targets() {
        const std::vector<char> none(at(rest_.vertex_count()), 0);
        const std::shared_ptr<const GltfAsset> clean = with_morph_animation(rest_, none, {});
        std::vector<MorphTarget> names;
        for (const PoseTarget& target : targets_) names.push_back({target.name, 0.0, true});
        rest_.set_asset(clean->with_morphs(names));
    }

    void measure(PoseTargetReport& report) const {
        for (const PoseTarget& target : targets_) {
            for (int k = 1; k <= kSampleSteps; ++k) {
                NamedWeights at = summed(target.at);
                for (auto& [name, weight] : at) weight *= static_cast<double>(k) / kSampleSteps;
                const std::vector<Vec3> goal = space_.positions(listed(at), context_);
                report.linear_error =
                    std::max(report.linear_error, distance(goal, at, pose_count_));
                report.error = std::max(report.error, distance(goal, at, targets_.size()));
            }
        }
        report.targets = targets_;
    }

    double distance(const std::vector<Vec3>& goal, const NamedWeights& weights,
                    std::size_t count) const {
        const TargetShape sum = sum_at(weights, count);
        double greatest = 0.0;
        for (std::size_t v = 0; v < goal.size(); ++v) {
            greatest = std::max(greatest, (sum.positions[v] - goal[v]).norm());
        }
        return greatest;
    }

    const PoseSpace& space_;
    const Context& context_;
    Mesh rest_;
    bool has_normals_ = false, makes_normals_ = false;
    TargetShape rest_shape_;
    std::vector<PoseTarget> targets_;
    std::size_t pose_count_ = 0;
    std::vector<TargetShape> changes_;
};

}  // namespace

Mesh pose_targets(const PoseSpace& space, const PoseTargetOptions& options,
                  PoseTargetReport* report, const Context& context) {
    PoseTargetReport measured;
    Mesh mesh = TargetMaker(space, options, context).make(report ? &measured : nullptr);
    if (report) *report = std::move(measured);
    return mesh;
}

std::vector<double> target_weights(const std::vector<PoseTarget>& targets,
                                   const std::vector<PoseWeight>& weights) {
    const NamedWeights sums = summed(weights);
    std::vector<double> result;
    for (const PoseTarget& target : targets) result.push_back(drive(target, sums));
    return result;
}

}  // namespace lissom
