#include "viewer/render/gl/gpu_hair.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "viewer/render/draw/studio_light.h"
#include "viewer/render/gl/shaders.h"

namespace lissom {
namespace {

// Points of a buffer: sending one takes no longer than a slice of drawing.
constexpr Index kPagePoints = 1 << 20;

// A rotation: the matrix of a view has no scale.
Mat3 turn_of(const HairView& view) {
    return view.parameters.view.topLeftCorner<3, 3>();
}

Vec3 unit(const Eigen::Vector3f& direction) {
    return direction.cast<double>().normalized();
}

// From the strands' metres to view space.
Mat4 to_view(const HairView& view, const DrawnStrands& drawn) {
    const Affine placed = translation(-view.origin) * drawn.transform;
    Mat4 matrix = Mat4::Identity();
    matrix.topLeftCorner<3, 3>() = placed.linear / drawn.style.unit;
    matrix.topRightCorner<3, 1>() = placed.translation;
    return view.parameters.view * matrix;
}

double scale_of(const DrawnStrands& drawn) {
    return std::cbrt(std::abs(drawn.transform.linear.determinant())) / drawn.style.unit;
}

Vec2 turn_by(double angle) {
    return {std::cos(angle), std::sin(angle)};
}

// From view space to the texture coordinates of a grid about `origin`.
Mat4 to_grid(const HairView& view, const HairLight& light) {
    GpuHairShade place;
    place_shade(place, light.grid());
    Mat4 scaled = Mat4::Identity();
    scaled.diagonal().head<3>() = place.scale;
    scaled.topRightCorner<3, 1>() = place.offset;
    Mat4 moved = Mat4::Identity();
    moved.topRightCorner<3, 1>() = view.origin - light.origin();
    return scaled * moved * view.parameters.view.inverse();
}

std::shared_ptr<const gl::Texture> volume_of(const ViewGrid& grid,
                                             std::span<const std::uint8_t> texels) {
    return std::make_shared<const gl::Texture>(gl::make_volume(grid.counts, texels));
}

}  // namespace

GpuHair::GpuHair()
    : program_("strand", shaders::kCommon, shaders::kStrandVertex, shaders::kStrandFragment),
      no_vertices_(gl::make_vertex_array()),
      no_hair_(upload_shade(nullptr)) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    max_points_ = std::min(static_cast<Index>(most), kPagePoints);
}

Index GpuHair::total(const Part& part) {
    return drawn_count(part.source.drawn.style, part.source.drawn.strands->size());
}

Index GpuHair::count_of_part(const Part& part, double share) {
    return static_cast<Index>(std::lround(std::clamp(share, 0.0, 1.0) * total(part)));
}

std::shared_ptr<const GpuHair::Ribbons> GpuHair::send(const PackedRibbons& packed,
                                                      std::size_t& sent) const {
    auto ribbons = std::make_shared<Ribbons>();
    ribbons->offsets = packed.offsets;
    for (Index first = 0; first < packed.size();) {
        const Index base = packed.offsets[at(first)];
        Index last = first + 1;
        while (last < packed.size() && packed.offsets[at(last) + 1] - base <= max_points_) ++last;
        const auto count = static_cast<std::size_t>(packed.offsets[at(last)] - base);
        if (count > 0) {
            const std::span points = std::span(packed.points).subspan(at(base), count);
            const std::span shifts = std::span(packed.shifts).subspan(at(base), count);
            ribbons->pages.push_back({gl::make_texture_buffer(std::as_bytes(points), GL_RGBA32UI),
                                      gl::make_texture_buffer(std::as_bytes(shifts), GL_R8), first,
                                      last, base});
            sent += points.size_bytes() + shifts.size_bytes();
        }
        first = last;
    }
    gl::check_errors("the strands");
    return ribbons;
}

std::size_t GpuHair::update(const Hair& hair) {
    std::size_t sent = 0;
    std::vector<Part> parts;
    for (const HairPart& part : hair.parts) {
        const auto is_it = [&](const Part& known) { return known.source.packed == part.packed; };
        const auto known = std::find_if(parts_.begin(), parts_.end(), is_it);
        if (known != parts_.end()) {
            parts.push_back({part, known->all, known->few});
        } else {
            parts.push_back({part, send(part.packed->all, sent), send(part.packed->few, sent)});
        }
    }
    sent += update_light(hair.light);
    parts_ = std::move(parts);
    count();
    return sent;
}

std::size_t GpuHair::update_light(std::shared_ptr<const HairLight> light) {
    if (light == light_) return 0;
    directed_ = false;
    volume_ = for_strands_ = for_meshes_ = nullptr;
    light_ = std::move(light);
    if (!light_) return 0;
    const ViewGrid& grid = light_->grid();
    volume_ = volume_of(grid, light_->undirected());
    for_strands_ = volume_of(grid, light_->for_strands());
    for_meshes_ = volume_of(grid, light_->for_meshes());
    gl::check_errors("the light in hair");
    return 12 * grid.size();
}

void GpuHair::count() {
    size_ = 0;
    few_ = 1.0;
    complete_ = true;
    for (const Part& part : parts_) {
        const Index count = total(part);
        size_ += count;
        complete_ = complete_ && part.all->size() == count;
        few_ = std::min(few_, count > 0 ? 1.0 * part.few->size() / count : 1.0);
    }
}

std::size_t GpuHair::direct(std::span<const std::uint8_t> light) {
    if (!light_ || light.size() != 4 * light_->grid().size()) return 0;
    volume_ = volume_of(light_->grid(), light);
    gl::check_errors("the light in hair");
    directed_ = true;
    return light.size();
}

double GpuHair::width(double of) const {
    double widest = 0.0;
    for (const Part& part : parts_) {
        const PackedStrands& packed = *part.source.packed;
        const double wider = widening(packed, count_of_part(part, of), total(part));
        widest = std::max(widest, packed.widest * scale_of(part.source.drawn) * wider);
    }
    return widest;
}

Vec3 GpuHair::middle() const {
    if (!light_) return Vec3::Zero();
    const ViewGrid& grid = light_->grid();
    const Vec3 extent(grid.counts[0] - 1, grid.counts[1] - 1, grid.counts[2] - 1);
    return light_->origin() + grid.origin.cast<double>() + 0.5 * grid.step * extent;
}

GpuHairShade GpuHair::shade(const HairView& view) const {
    if (!light_) return no_hair_;
    GpuHairShade shade;
    place_shade(shade, light_->grid());
    shade.kind = directed_ ? GpuHairShade::Kind::directed : GpuHairShade::Kind::moments;
    shade.volume = volume_;
    shade.moments = for_meshes_;
    const Mat3 turn = turn_of(view);
    shade.turn = turn.transpose();
    // Position of the grid's zero in view space: behind the rotation and before the scale.
    const Vec3 eye = view.parameters.view.topRightCorner<3, 1>();
    const Vec3 moved = view.origin - light_->origin() - turn.transpose() * eye;
    shade.offset += moved.cwiseProduct(shade.scale);
    color_shade(shade, light_->scalp_color());
    return shade;
}

void GpuHair::use(const HairView& view) const {
    const HairLight& light = *light_;
    const Mat3 from_view = turn_of(view).transpose();
    const Mat4 grid = to_grid(view, light);
    const double nearer = kTowardsLight * light.grid().step;
    const Vec3 key = unit(kKeyLight.direction), rim = unit(kRimLight.direction);
    program_.use();
    program_.set("u_projection", view.projection);
    program_.set("u_perspective", view.parameters.perspective ? 1.0f : 0.0f);
    program_.set("u_brightest", kBrightest);
    program_.set("u_thinnest", static_cast<float>(view.thinnest));
    program_.set_volume("u_light", 2, volume_->id());
    program_.set_volume("u_moments", 3, for_strands_->id());
    program_.set("u_directed", directed_ ? 1 : 0);
    program_.set("u_to_grid", grid);
    program_.set("u_key_grid", Vec3(grid.topLeftCorner<3, 3>() * key * nearer));
    program_.set("u_rim_grid", Vec3(grid.topLeftCorner<3, 3>() * rim * nearer));
    program_.set("u_key_world", Vec3(from_view * key));
    program_.set("u_rim_world", Vec3(from_view * rim));
    program_.set("u_up_world", Vec3(from_view.col(1)));
    program_.set("u_slope", ambient_slope());
}

void GpuHair::use(const Part& part, const HairView& view, double widening) const {
    const DrawnStrands& drawn = part.source.drawn;
    const StrandStyle& style = drawn.style;
    program_.set("u_to_view", to_view(view, drawn));
    program_.set("u_width",
                 static_cast<float>(part.source.packed->widest * scale_of(drawn) * widening));
    program_.set("u_primary_turn", turn_by(style.primary.shift));
    program_.set("u_secondary_turn", turn_by(style.secondary.shift));
    program_.set("u_lobes", Vec4(style.primary.strength, style.secondary.strength,
                                 style.primary.exponent, style.secondary.exponent));
    program_.set("u_jitter", static_cast<float>(style.shift_jitter));
}

void GpuHair::draw(const HairView& view, const HairRange& range) const {
    if (empty() || !light_) return;
    use(view);
    glBindVertexArray(no_vertices_.id());
    for (const Part& part : parts_) {
        const Index begin = count_of_part(part, range.begin);
        const Index end = count_of_part(part, range.end);
        const Index of = std::max(count_of_part(part, range.of), Index{1});
        const bool few = part.all->size() == 0 || (range.few_points && of <= part.few->size());
        const Ribbons& ribbons = few ? *part.few : *part.all;
        use(part, view, widening(*part.source.packed, of, total(part)));
        for (const Page& page : ribbons.pages) {
            const Index first = std::clamp(begin, page.first, page.last);
            const Index last = std::clamp(end, page.first, page.last);
            const Index from = ribbons.offsets[at(first)], to = ribbons.offsets[at(last)];
            if (from == to) continue;
            program_.set_buffer("u_points", 0, page.points.texture.id());
            program_.set_buffer("u_shifts", 1, page.shifts.texture.id());
            glDrawArrays(GL_TRIANGLE_STRIP, 2 * (from - page.base), 2 * (to - from));
        }
    }
}

}  // namespace lissom
