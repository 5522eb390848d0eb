/// SceneUpload: brings the shown picture onto the graphics card. Long work is done beside the
/// window and sent in pieces; the window shows the previous picture meanwhile.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "kernel/core/error.h"
#include "viewer/window/app/hair_fill.h"
#include "viewer/window/app/view_state.h"
#include "viewer/window/makers/surface_maker.h"

namespace lissom::window {

class SceneUpload {
  public:
    /// Makes surfaces ready with `threads` threads; both must outlive it.
    SceneUpload(ViewState& state, HairFill& hair, int threads);

    /// Returns whether the shown picture is on the graphics card.
    bool is_sent() const;
    /// Returns whether the picture on the graphics card was made by other settings.
    bool has_other_settings() const { return !(sent_settings_ == state_.settings); }
    /// Sends it, or begins to. Errors: those of GpuScene::update; internal.
    void send();
    /// Takes the prepared picture.
    void take();
    /// Sends some pieces of it.
    void send_pieces();
    bool has_pieces() const { return pieces_left_; }
    /// Reports a picture that cannot be drawn, and shows nothing.
    void give_up(const Error& error);
    /// The graphics card has lost all.
    void forget();

  private:
    struct Sent {
        Snapshot snapshot;
        std::shared_ptr<const Picture> picture;
        DisplaySettings settings;
    };
    void begin_sending();
    bool end_sending();
    void send(const Sent& sent, std::span<const PreparedSurface> prepared);
    void forget_preparing();

    ViewState& state_;
    HairFill& hair_;
    SurfaceMaker maker_;
    // The picture being prepared, the prepared one, and its sender.
    std::optional<Sent> preparing_;
    std::optional<SurfaceMaker::Result> prepared_;
    std::optional<PieceSender> sender_;
    bool pieces_left_ = false;
    std::uint64_t preparations_ = 0;
    // The picture on the graphics card.
    std::shared_ptr<const Picture> sent_;
    DisplaySettings sent_settings_;
};

}  // namespace lissom::window
