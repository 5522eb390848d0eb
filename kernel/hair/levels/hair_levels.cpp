#include "kernel/hair/levels/hair_levels.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/hair/levels/spread_order.h"
#include "kernel/hair/strands/strand_edit.h"
#include "kernel/hair/strands/strand_measures.h"
#include "kernel/hair/strands/strand_resample.h"

namespace lissom {
namespace {

constexpr double kPictureLines = 1080.0;
constexpr Index kLeastShellTriangles = 20;
// One in so many of a shell's triangles is skin between hair.
constexpr Index kSkinShare = 4;
// Metres by which that skin may move when it is decimated.
constexpr double kSkinError = 0.003;
// Tried for a shell, after the one asked for.
constexpr double kShellDensities[] = {0.28, 0.4, 0.5, 0.6, 0.72, 0.85};
constexpr std::size_t kMaxLevelGroups = 1000;

void require_strand_level(const StrandLevelOptions& level, Index all) {
    require((level.count != 0) != (level.screen_size != 0.0),
            "a level of strands needs either a count of 1 or more, or a screen size");
    require(level.count >= 0 && level.count <= all,
            "a level of " + std::to_string(level.count) + " strands cannot be made: the hair has " +
                std::to_string(all) + "; give a count of at most that");
    require(level.screen_size >= 0.0 && level.screen_size <= 1.0,
            "the screen size of a level must be above 0, at most 1");
    require(level.points == 0 || level.points >= 2, "strands of a level have at least 2 points");
    require(level.widen >= 0.0 && std::isfinite(level.widen),
            "the factor of widths must be finite and above 0");
}

void require_level_options(const Strands& strands, const HairLevelOptions& options) {
    require(!strands.empty(), "levels need hair; there are no strands");
    require(!options.by_group || strands.group_names().size() <= kMaxLevelGroups,
            "levels of groups are made of at most 1000 groups; this hair has " +
                std::to_string(strands.group_names().size()));
    require(!options.strands.empty() || !options.cards.empty() || options.shell,
            "there are no levels; give some of strands, cards or a shell");
    require(options.strands.size() <= kMaxHairLevels && options.cards.size() <= kMaxHairLevels,
            "there are at most 8 levels of strands, and 8 of cards");
    require(options.width >= 0.0 && std::isfinite(options.width),
            "the width of full hair must be finite and not negative");
    require(options.silhouette.views >= 1 && options.silhouette.views <= 64 &&
                options.silhouette.pixel >= 0.0005 && options.silhouette.pixel <= 0.1,
            "silhouettes need 1 to 64 views, and a pixel of 0.0005 to 0.1 metres");
    for (const StrandLevelOptions& level : options.strands) {
        require_strand_level(level, strands.size());
    }
    for (const CardOptions& level : options.cards) {
        require(level.count >= 1 && level.count <= kMaxCards,
                "a level has 1 to " + std::to_string(kMaxCards) + " cards");
    }
    require(!options.shell || (options.shell->triangles >= kLeastShellTriangles &&
                               options.shell->triangles <= kMaxShellTriangles),
            "a shell has 20 to " + std::to_string(kMaxShellTriangles) + " triangles");
}

// A part of a budget, at least `least`; all of it stays as it is.
Index share_of(Index budget, double part, Index least) {
    if (part == 1.0) return budget;
    return std::max(least, static_cast<Index>(std::lround(part * budget)));
}

Strands with_full_width(const Strands& strands, double width) {
    Strands full = strands;
    if (width == 0.0) return full;
    StrandWidths widths;
    widths.common = static_cast<float>(width);
    widths.profile = strands.widths().profile;
    full.set_widths(std::move(widths));
    return full;
}

void widen_strands(Strands& strands, double widen) {
    StrandWidths widths = strands.widths();
    widths.common *= static_cast<float>(widen);
    for (float& width : widths.values) width *= static_cast<float>(widen);
    strands.set_widths(std::move(widths));
}

// The hair of a group, or all.
class LevelMaker {
  public:
    // `height` is that of all hair, `part` the part of its strands that are these.
    LevelMaker(const Strands& hair, const HairLevelOptions& options, double height, double part,
               const Context& context)
        : hair_(hair),
          full_(with_full_width(hair, options.width)),
          options_(options),
          height_(height),
          part_(part),
          context_(context),
          silhouette_(full_, options.silhouette, context),
          order_(spread_order(hair)) {}

    HairLevel strands(const StrandLevelOptions& level) const {
        HairLevel made;
        const double kept =
            level.count > 0 ? part_ * level.count : level.screen_size * hair_.size();
        const Index count =
            std::clamp<Index>(static_cast<Index>(std::lround(kept)), 1, hair_.size());
        made.screen_size = static_cast<double>(count) / hair_.size();
        made.widen = level.widen > 0.0 ? level.widen : 1.0 / made.screen_size;
        made.strands = part_of(hair_, count, level.points);
        widen_strands(made.strands, made.widen);
        made.silhouette = silhouette_.compare(
            options_.width == 0.0 ? made.strands : part_of(full_, count, level.points),
            options_.width == 0.0 ? 1.0 : made.widen, context_);
        return made;
    }

    HairLevel cards(CardOptions level) const {
        HairLevel made;
        made.kind = HairLevelKind::cards;
        level.count = share_of(level.count, part_, 1);
        if (level.triangles > 0)
            level.triangles = share_of(level.triangles, part_, 2 * level.count);
        made.cards = make_cards(full_, level, context_);
        if (options_.head) add_cap(made.cards, full_, *options_.head, options_.cap, context_);
        made.mesh = card_mesh(made.cards, full_, level, context_);
        made.strands = full_;
        made.screen_size = size_of_error(made.cards.rms);
        made.silhouette = silhouette_.compare(made.cards, full_, context_);
        return made;
    }

    HairLevel shell(ShellOptions level) const {
        HairLevel made;
        made.kind = HairLevelKind::shell;
        level.triangles = share_of(level.triangles, part_, kLeastShellTriangles);
        const Mesh skin = skin_below(level);
        // Decimation may leave more of the skin than its share.
        level.triangles = std::max(
            {kLeastShellTriangles, level.triangles / 2, level.triangles - skin.face_count()});
        fit_shell(level, made);
        if (skin.face_count() > 0) add_skin(made.mesh, skin, full_, context_);
        made.screen_size = size_of_error(level.cell);
        return made;
    }

  private:
    // Skin with hair that is too thin for a shell; none without a head.
    Mesh skin_below(const ShellOptions& level) const {
        if (!options_.head || full_.roots().faces.empty()) return {};
        CardCapOptions cap = options_.cap;
        cap.triangles = std::min(cap.triangles, level.triangles / kSkinShare);
        cap.error = std::max(cap.error, kSkinError);
        return cut_cap(make_cap(full_, *options_.head, cap, context_), context_);
    }

    // The silhouette is that of the shell without skin, which the head covers as well.
    void fit_shell(ShellOptions level, HairLevel& made) const {
        const auto take = [&](double density) {
            level.level = density;
            Mesh mesh = make_shell(full_, level, context_);
            const SilhouetteError error = silhouette_.compare(mesh, context_);
            if (made.mesh.face_count() > 0 && error.mean >= made.silhouette.mean) return false;
            made.mesh = std::move(mesh);
            made.silhouette = error;
            return true;
        };
        take(level.level);
        if (!options_.fit_shell) return;
        // The error falls and then rises with the density; thin hair has no shell of a high one.
        try {
            for (const double density : kShellDensities) {
                if (density > level.level && !take(density)) break;
            }
        } catch (const Error& error) {
            if (error.code() != ErrorCode::invalid_argument) throw;
        }
    }

    Strands part_of(const Strands& strands, Index count, Index points) const {
        Strands part = select(strands, std::span(order_).first(at(count)));
        return points == 0 ? part : resample(part, {.count = points}, context_);
    }

    // The part of a picture's height that hair has whose details of `size` metres are a pixel.
    double size_of_error(double size) const {
        return std::min(1.0, height_ / (kPictureLines * std::max(size, 1e-6)));
    }

    const Strands& hair_;
    Strands full_;
    const HairLevelOptions& options_;
    double height_, part_;
    const Context& context_;
    HairSilhouette silhouette_;
    std::vector<Index> order_;
};

// Strands of each group in turn, then those of none; all in one if they are not asked for.
std::vector<std::pair<Index, Strands>> parts_of(const Strands& strands, bool by_group,
                                                const Context& context) {
    std::vector<std::pair<Index, Strands>> parts;
    if (!by_group || strands.groups().empty()) {
        parts.emplace_back(kNoIndex, strands);
        return parts;
    }
    const Index groups = count_of(strands.group_names());
    std::vector<std::vector<Index>> lists(at(groups) + 1);
    for (Index s = 0; s < strands.size(); ++s) {
        const Index group = strands.group(s);
        lists[at(group == kNoIndex ? groups : group)].push_back(s);
    }
    for (Index group = 0; group <= groups; ++group) {
        context.checkpoint();
        if (lists[at(group)].empty()) continue;
        parts.emplace_back(group < groups ? group : kNoIndex, select(strands, lists[at(group)]));
    }
    return parts;
}

// The maker of the levels of a group, or none if so little hair covers no pixel, as that of a few
// strands which no tie holds.
std::optional<LevelMaker> maker_of(const Strands& part, const HairLevelOptions& options,
                                   double height, double share, const Context& context) {
    try {
        return std::optional<LevelMaker>(std::in_place, part, options, height, share, context);
    } catch (const Error& error) {
        if (share == 1.0 || error.code() != ErrorCode::invalid_argument) throw;
        return std::nullopt;
    }
}

void add_levels(const Strands& strands, const std::pair<Index, Strands>& part,
                const HairLevelOptions& options, const Context& context, Progress& progress,
                std::vector<HairLevel>& levels) {
    const double share = static_cast<double>(part.second.size()) / strands.size();
    const Box box = bounds(strands);
    const auto count = static_cast<double>(options.strands.size() + options.cards.size() +
                                           (options.shell ? 1 : 0) + 1);
    progress.step(share / count);
    const auto maker = maker_of(part.second, options, box.max.y() - box.min.y(), share, context);
    if (!maker) {
        context.log(LogLevel::warning, std::to_string(part.second.size()) +
                                           " strands of a group have no levels: they cover no "
                                           "pixel by half");
        return;
    }
    const auto add = [&](const auto& make) {
        progress.step(share / count);
        levels.push_back(make());
        levels.back().group = part.first;
    };
    for (const StrandLevelOptions& level : options.strands) {
        add([&] { return maker->strands(level); });
    }
    for (const CardOptions& level : options.cards) add([&] { return maker->cards(level); });
    if (options.shell) add([&] { return maker->shell(*options.shell); });
}

}  // namespace

HairLevelOptions usual_hair_levels() {
    HairLevelOptions options;
    options.strands = {{.screen_size = 1.0, .points = 24},
                       {.screen_size = 0.5, .points = 16},
                       {.screen_size = 0.25, .points = 12}};
    options.cards = {CardOptions{.count = 200, .sections = 16},
                     CardOptions{.count = 100, .sections = 10},
                     CardOptions{.count = 50, .sections = 8}};
    options.shell = ShellOptions{};
    return options;
}

std::vector<HairLevel> make_hair_levels(const Strands& strands, const HairLevelOptions& options,
                                        const Context& context) {
    require_level_options(strands, options);
    Progress progress(context, "levels of hair");
    std::vector<HairLevel> levels;
    for (const auto& part : parts_of(strands, options.by_group, context)) {
        try {
            add_levels(strands, part, options, context, progress, levels);
        } catch (const Error& error) {
            if (part.first == kNoIndex || error.code() != ErrorCode::invalid_argument) throw;
            throw Error(error.code(), "group '" + strands.group_names()[at(part.first)] +
                                          "': " + error.message());
        }
    }
    require(!levels.empty(), "no group covers a pixel by half; widen the hair, or give a width");
    return levels;
}

}  // namespace lissom
