#include "tests/bench/sketch_hair.h"

#include <cmath>
#include <memory>
#include <vector>

#include "kernel/hair/comb.h"
#include "kernel/hair/hairstyle.h"
#include "kernel/mesh/shapes/head.h"
#include "kernel/sketch/stroke.h"
#include "kernel/sketch/stroke_cloud.h"
#include "kernel/sketch/stroke_depth.h"

namespace lissom::bench {
namespace {

constexpr Index kResolution = 50000, kLive = 10000, kAll = 100000;

Vec3 over(const Scalp& scalp, double azimuth, double elevation, double lift) {
    return scalp.at({azimuth * kDegree, elevation * kDegree}, lift).position;
}

/// A stream down the head at an azimuth, in mesh units.
std::vector<Vec3> stream_at(const Scalp& scalp, double azimuth) {
    std::vector<Vec3> points;
    for (const double elevation : {65.0, 45.0, 20.0, -5.0, -30.0}) {
        points.push_back(over(scalp, azimuth, elevation, elevation > 60.0 ? 0.01 : 0.025));
    }
    return points;
}

std::vector<Vec3> in_metres(const Scalp& scalp, std::vector<Vec3> points) {
    for (Vec3& p : points) p = scalp.to_metres(p);
    return points;
}

/// What a hand draws, at one event a few pixels, along points of the world.
std::vector<StrokeEvent> drawn(const View& view, const std::vector<Vec3>& points) {
    std::vector<StrokeEvent> events;
    constexpr int kEvents = 30;
    for (std::size_t i = 1; i < points.size(); ++i) {
        for (int k = 0; k < kEvents; ++k) {
            const double t = static_cast<double>(k) / kEvents;
            const Vec3 seen = view.project((1.0 - t) * points[i - 1] + t * points[i]);
            events.push_back({{seen.x(), seen.y() + std::sin(7.0 * k)}});
            events.back().time = 0.008 * static_cast<double>(events.size());
        }
    }
    return events;
}

class Sketch {
  public:
    explicit Sketch(const Context& context)
        : context_(context),
          head_(make_head()),
          scalp_(std::make_shared<const Scalp>(head_)),
          view_{frame_points(StandardView::left, head_.positions()), {1280, 960}},
          style_(head_, scalp_, options(), context) {
        for (int i = 0; i < 10; ++i) {
            StreamCurve stream;
            stream.points = in_metres(*scalp_, stream_at(*scalp_, 36.0 * i));
            ids_.push_back(style_.add({std::move(stream)}));
        }
    }

    /// A stroke so far, taken for a stream: its fair line, its depth, the field and hair.
    double draw_event(Index count) {
        turn_ += 0.7;
        const auto events = drawn(view_, stream_at(*scalp_, 90.0 + std::fmod(turn_, 20.0)));
        return seconds([&] {
            const Stroke stroke = fair_stroke(events, {});
            const auto points = stroke_over_head(stroke.points, view_, {scalp_->tree(), faces()},
                                                 envelope(), context_);
            style_.set_points(ids_[2], in_metres(*scalp_, points));
            grow(count);
        });
    }
    /// A curve that is dragged: the field and hair.
    double drag_event(Index count) {
        turn_ += 0.7;
        auto points = in_metres(*scalp_, stream_at(*scalp_, 108.0 + std::fmod(turn_, 20.0)));
        return seconds([&] {
            style_.set_points(ids_[3], std::move(points));
            grow(count);
        });
    }
    /// A stroke through grown hair: its depth, the streams that it bends, the field.
    double comb_event() {
        const StyleInputs before = style_.inputs();
        std::vector<Vec3> way;
        for (double azimuth = 70.0; azimuth < 131.0; azimuth += 10.0) {
            way.push_back(over(*scalp_, azimuth, 20.0, 0.03));
        }
        const auto events = drawn(view_, way);
        grow(kAll);
        const double time = seconds([&] {
            const Stroke stroke = fair_stroke(events, {});
            const auto points =
                stroke_before_cloud(stroke.points, view_, strands_.points(), {}, context_);
            comb(style_, in_metres(*scalp_, points), {}, context_);
        });
        style_.restore(before);
        return time;
    }
    void grow(Index count) {
        HairOptions hair;
        hair.roots.count = count;
        style_.grow(hair, strands_, context_);
    }

  private:
    static HairstyleOptions options() {
        HairstyleOptions options;
        options.resolution = kResolution;
        return options;
    }
    EnvelopeOptions envelope() const {
        EnvelopeOptions options;
        options.metre = scalp_->scale();
        return options;
    }
    std::span<const char> faces() {
        if (faces_.empty()) {
            faces_.assign(static_cast<std::size_t>(head_.face_count()), 0);
            for (const Index f : scalp_->region().faces()) faces_[static_cast<std::size_t>(f)] = 1;
        }
        return faces_;
    }

    const Context& context_;
    Mesh head_;
    std::shared_ptr<const Scalp> scalp_;
    View view_;
    Hairstyle style_;
    std::vector<CurveId> ids_;
    std::vector<char> faces_;
    Strands strands_;
    double turn_ = 0.0;
};

template <typename Event>
double typical(const Event& event) {
    constexpr int kWarm = 2, kEvents = 15;
    std::vector<double> times;
    for (int i = 0; i < kWarm + kEvents; ++i) {
        const double time = event();
        if (i >= kWarm) times.push_back(1e3 * time);
    }
    return quantile(times, 0.5);
}

}  // namespace

void run_sketched_hair(Report& report) {
    const Context context;
    Sketch sketch(context);
    report.title("Hair under a hand: ten streams, 50K grid points");
    report.add({"a stream that is drawn, event to 10K strands",
                typical([&] { return sketch.draw_event(kLive); }), "ms", 40.0});
    report.add({"a stream that is dragged, event to 10K strands",
                typical([&] { return sketch.drag_event(kLive); }), "ms", 40.0});
    report.add({"a stream that is dragged, event to 100K strands",
                typical([&] { return sketch.drag_event(kAll); }), "ms", 60.0});
    report.add({"a comb through 100K strands", typical([&] { return sketch.comb_event(); }), "ms"});
}

}  // namespace lissom::bench
