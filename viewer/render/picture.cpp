#include "viewer/render/picture.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>

#include "kernel/core/error.h"
#include "viewer/render/draw/image/overlay.h"

namespace lissom {
namespace {

void require_faces(const std::vector<DrawnMesh>& meshes) {
    for (const DrawnMesh& drawn : meshes) {
        if (drawn.mesh->face_count() > 0) continue;
        throw Error(ErrorCode::mesh_empty, "a mesh without faces cannot be drawn");
    }
}

// Points of meshes that a window frames in a moment, at most twice as many.
constexpr std::size_t kFramedPoints = 20000;
// Points that mark strands: at most so many, evenly chosen.
constexpr Index kFramedStrands = 5000;

void add_framed(const DrawnStrands& drawn, std::vector<Vec3>& points) {
    const Strands& strands = *drawn.strands;
    const Index stride = std::max(strands.size() / kFramedStrands, Index{1});
    for (Index s = 0; s < strands.size(); s += stride) {
        const StrandView strand = strands.strand(s);
        for (Eigen::Index i = 0; i < strand.cols(); ++i) {
            const Vec3 p = strand.col(i).cast<double>();
            const Vec3 point = drawn.transform(p / drawn.style.unit);
            if (point.allFinite()) points.push_back(point);
        }
    }
}

// Everything that a standard view frames.
std::vector<Vec3> framed_points(const Snapshot& snapshot) {
    std::vector<Vec3> points;
    for_each_point(snapshot, [&](const Vec3& p) { points.push_back(p); });
    for (const DrawnStrands& drawn : snapshot.strands) add_framed(drawn, points);
    return points;
}

// Cells of a picture: one for everything, or one a mesh.
class Cells {
  public:
    Cells(const Picture& picture, int width, int height)
        : width_(width), height_(height), count_(count_of(picture.meshes)) {
        if (picture.columns > 0) columns_ = std::min(picture.columns, std::max(count_, 1));
        if (picture.columns > 0) rows_ = (count_ + columns_ - 1) / columns_;
        rows_ = std::max(rows_, 1);
        require(columns_ <= width && rows_ <= height,
                "the picture is too small for its cells or its legend; make it larger");
    }

    double aspect() const {
        return (static_cast<double>(width_) / columns_) / (static_cast<double>(height_) / rows_);
    }
    int left(int cell) const { return edge(cell % columns_, width_, columns_); }
    int top(int cell) const { return edge(cell / columns_, height_, rows_); }
    int width(int cell) const { return edge(cell % columns_ + 1, width_, columns_) - left(cell); }
    int height(int cell) const { return edge(cell / columns_ + 1, height_, rows_) - top(cell); }

  private:
    static int edge(int i, int size, int parts) {
        return index_of(static_cast<long long>(size) * i / parts);
    }

    int width_, height_, count_;
    int columns_ = 1, rows_ = 1;
};

// The strands that a mesh's cell shows, or all.
std::vector<DrawnStrands> strands_of(const Picture& picture, std::optional<std::size_t> mesh) {
    std::vector<DrawnStrands> result;
    for (const PictureStrands& strands : picture.strands) {
        if (!mesh || !strands.mesh || *strands.mesh == *mesh) result.push_back(strands.drawn);
    }
    return result;
}

// All in one space.
Snapshot whole(const Picture& picture, const ValueRange& range) {
    std::vector<std::shared_ptr<const Overlay>> overlays = {
        std::make_shared<const Overlay>(picture.marks)};
    if (!picture.tool_marks.lines.empty() || !picture.tool_marks.points.empty()) {
        auto marks = std::make_shared<Overlay>(picture.tool_marks);
        marks->on_top = true;
        overlays.push_back(std::move(marks));
    }
    return {picture.meshes, strands_of(picture, std::nullopt), std::move(overlays), range};
}

// Content of every cell; only the first if all is in one space.
std::vector<Snapshot> cells_of(const Picture& picture, const Snapshot& all) {
    if (picture.columns == 0) return {all};
    std::vector<Snapshot> cells;
    for (std::size_t i = 0; i < picture.meshes.size(); ++i) {
        cells.push_back({{picture.meshes[i]}, strands_of(picture, i), all.overlays, all.range});
    }
    return cells;
}

ValueRange range_of(const Picture& picture, const std::optional<ValueRange>& of_values) {
    require(!picture.range || picture.range->low < picture.range->high,
            "the range of values must have its low end below its high end");
    return picture.range.value_or(of_values.value_or(ValueRange{}));
}

// Height of capitals in captions, as a share of the cell and in pixels.
constexpr double kCaptionShare = 0.026;
constexpr double kMinimumCaption = 9.0;

double caption_text(int cell_height) {
    return std::max(kCaptionShare * cell_height, kMinimumCaption);
}

// Rows of pixels that captions take in a cell.
int caption_rows(const Picture& picture, int cell_height) {
    if (picture.captions.empty()) return 0;
    return std::min(index_of(std::lround(2.6 * caption_text(cell_height))), cell_height - 1);
}

// Centred in the last rows of the cell, smaller if it would not fit.
void draw_caption(Image& image, const std::string& caption, const Cells& cells, int cell,
                  const Color& ink) {
    const double room = 0.94 * cells.width(cell);
    double text = caption_text(cells.height(cell));
    const double wanted = lay_out_text(caption, text).width;
    if (wanted > room) text *= room / wanted;
    const double x = cells.left(cell) + 0.5 * (cells.width(cell) - std::min(wanted, room));
    const double base =
        cells.top(cell) + cells.height(cell) - 0.8 * caption_text(cells.height(cell));
    draw_text(image, caption, x, base, text, ink);
}

Camera camera_for(const Picture& picture, const Snapshot& framed, double aspect) {
    if (picture.camera) return *picture.camera;
    FramingOptions framing = picture.framing;
    framing.aspect = aspect;
    return frame_points(picture.view, framed_points(framed), framing);
}

// Distance between the middles of meshes that stand side by side, in their largest extent.
constexpr double kSpread = 1.25;

// Position of a mesh's cell if all are in one space.
std::vector<Vec3> spread(const Picture& picture) {
    double extent = 0.0;
    for (const DrawnMesh& drawn : picture.meshes) {
        Box box;
        for (const Vec3& p : drawn.mesh->positions()) box.extend(drawn.transform(p));
        if (!box.empty()) extent = std::max(extent, (box.max - box.min).maxCoeff());
    }
    const Vec3 down = picture.framing.up == ViewUp::y ? Vec3(-Vec3::UnitY()) : Vec3(-Vec3::UnitZ());
    std::vector<Vec3> places;
    for (int i = 0; i < count_of(picture.meshes); ++i) {
        const int row = i / picture.columns, column = i % picture.columns;
        places.push_back(kSpread * extent * (column * Vec3::UnitX() + row * down));
    }
    return places;
}

void move(PictureStrands& strands, const std::vector<Vec3>& places) {
    if (!strands.mesh) return;
    strands.drawn.transform = translation(places[*strands.mesh]) * strands.drawn.transform;
}

}  // namespace

Snapshot snapshot_of(const Picture& picture) {
    Picture placed = picture;
    if (picture.columns > 0) {
        const std::vector<Vec3> places = spread(picture);
        for (std::size_t i = 0; i < placed.meshes.size(); ++i) {
            placed.meshes[i].transform = translation(places[i]) * placed.meshes[i].transform;
        }
        for (PictureStrands& strands : placed.strands) move(strands, places);
    }
    for (std::size_t i = 0; i < placed.meshes.size(); ++i) placed.meshes[i].object = i + 1;
    return whole(placed, range_of(picture, range_of_values(picture.meshes)));
}

std::optional<Legend> legend_of(const Picture& picture) {
    const std::optional<ValueRange> of_values = range_of_values(picture.meshes);
    const bool has_legend = of_values || !picture.legend_parts.empty();
    if (!picture.legend || !has_legend) return std::nullopt;
    return Legend{range_of(picture, of_values), picture.legend_label, picture.legend_parts};
}

Camera quick_camera_of(const Picture& picture, const Snapshot& snapshot, double aspect) {
    if (picture.camera) return *picture.camera;
    std::size_t count = 0, place = 0;
    for (const DrawnMesh& drawn : snapshot.meshes) count += drawn.mesh->positions().size();
    const std::size_t stride = count / kFramedPoints + 1;
    std::vector<Vec3> points;
    for_each_point(snapshot, [&](const Vec3& p) {
        if (place++ % stride == 0) points.push_back(p);
    });
    for (const DrawnStrands& drawn : snapshot.strands) add_framed(drawn, points);
    FramingOptions framing = picture.framing;
    framing.aspect = aspect;
    return frame_points(picture.view, points, framing);
}

namespace {

bool same_attributes(const AttributeSet& a, const AttributeSet& b) {
    const auto same = [](const Attribute& x, const Attribute& y) {
        // Bits, so that NaN is itself.
        return x.name == y.name && x.domain == y.domain && x.width == y.width &&
               x.values.size() == y.values.size() &&
               std::memcmp(x.values.data(), y.values.data(), x.values.size() * sizeof(double)) == 0;
    };
    const auto& p = a.all();
    const auto& q = b.all();
    return std::equal(p.begin(), p.end(), q.begin(), q.end(), same);
}

}  // namespace

Picture FrozenMeshes::freeze(Picture picture) {
    for (DrawnMesh& drawn : picture.meshes) freeze(drawn);
    kept_ = std::exchange(next_, {});
    for (PictureStrands& strands : picture.strands) {
        strands.drawn.strands = std::make_shared<const Strands>(*strands.drawn.strands);
    }
    return picture;
}

void FrozenMeshes::freeze(DrawnMesh& drawn) {
    const std::shared_ptr<const Mesh> source = drawn.mesh;
    const auto holds = [&](const Kept& kept) {
        return kept.source.lock() == source && kept.copy->revision() == source->revision() &&
               kept.copy->shared_topology() == source->shared_topology() &&
               same_attributes(kept.copy->attributes(), source->attributes());
    };
    const auto found = std::find_if(kept_.begin(), kept_.end(), holds);
    drawn.mesh = found == kept_.end() ? std::make_shared<const Mesh>(*source) : found->copy;
    if (regions_of(drawn) != source->regions()) {
        drawn.regions = std::make_shared<const NamedRegions>(source->regions());
    }
    next_.push_back({source, drawn.mesh});
}

Picture frozen(Picture picture) {
    return FrozenMeshes().freeze(std::move(picture));
}

Image draw_picture(Renderer& renderer, const Picture& picture, const Context& context) {
    require_faces(picture.meshes);
    require(picture.columns >= 0, "columns must be 0 (all meshes in one space) or more");
    require(picture.captions.empty() || picture.captions.size() == picture.meshes.size(),
            "give one caption for each mesh");
    require(picture.captions.empty() || picture.columns > 0,
            "captions stand below cells; set columns");
    const RenderOptions& options = picture.options;
    renderer.require_valid(options);

    const std::optional<Legend> legend = legend_of(picture);
    const int strip = legend ? legend_width(*legend, options.height) : 0;
    const Cells cells(picture, options.width - strip, options.height);
    const Snapshot all = whole(picture, range_of(picture, range_of_values(picture.meshes)));
    const std::vector<Snapshot> snapshots = cells_of(picture, all);

    const MemoryCharge charge =
        context.charge(std::size_t{4} * at(options.width) * at(options.height), "the picture");
    Image image(options.width, options.height);
    if (options.background) {
        fill_rectangle(image, 0, 0, image.width, image.height, *options.background);
    }
    Progress progress(context, "render");
    for (std::size_t i = 0; i < snapshots.size(); ++i) {
        progress.step(1.0 / snapshots.size());
        const int cell = index_of(i);
        RenderOptions part = options;
        part.width = cells.width(cell);
        part.height = cells.height(cell) - caption_rows(picture, cells.height(cell));
        const double aspect =
            picture.captions.empty() ? cells.aspect() : 1.0 * part.width / part.height;
        const Camera camera = camera_for(picture, picture.fit_each ? snapshots[i] : all, aspect);
        image.paste(renderer.render(snapshots[i], camera, part, context), cells.left(cell),
                    cells.top(cell));
        if (!picture.captions.empty()) {
            draw_caption(image, picture.captions[i], cells, cell, ink_on(options.background));
        }
    }
    if (legend) draw_legend(image, *legend, ink_on(options.background));
    return image;
}

}  // namespace lissom
