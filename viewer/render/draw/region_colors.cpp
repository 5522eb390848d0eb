#include "viewer/render/draw/region_colors.h"

#include <algorithm>
#include <functional>
#include <map>

namespace lissom {
namespace {

// Colours of surfaces that are told apart by number; paler after each eight.
Color part_color(std::size_t number) {
    constexpr double kPaler = 0.25;
    const double pale = kPaler * static_cast<double>(1 + number / 8 % 3);
    return mix(category_color(number), kWhite, pale);
}

}  // namespace

std::vector<LegendPart> color_regions(std::vector<DrawnMesh>& meshes,
                                      const std::vector<std::string>& names) {
    const auto is_wanted = [&](const std::string& name) {
        return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
    };
    std::map<std::string, Color, std::less<>> colors;
    for (const DrawnMesh& drawn : meshes) {
        for (const auto& [name, region] : regions_of(drawn)) {
            if (is_wanted(name)) colors.emplace(name, Color{});
        }
    }
    std::vector<LegendPart> legend;
    for (auto& [name, color] : colors) {
        color = part_color(legend.size());
        legend.push_back({name, color});
    }
    for (DrawnMesh& drawn : meshes) {
        std::vector<DrawnRegion>& parts = drawn.style.parts;
        for (const auto& [name, region] : regions_of(drawn)) {
            const auto found = colors.find(name);
            if (found != colors.end()) parts.push_back({region, found->second});
        }
        std::stable_sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
            return a.region.size() > b.region.size();
        });
    }
    return legend;
}

}  // namespace lissom
