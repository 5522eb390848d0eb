/// Coloring: source of the colours of a window's meshes, as chosen: their own, the numbers of an
/// attribute, their regions, or their distortion; or the field of hairstyles.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "viewer/render/picture.h"

namespace lissom::window {

struct Coloring {
    /// values: an attribute of the vertices. stretch, area, angle: against another shape of the
    /// same faces, see Distortion. field: their own, with arrows of the field and constraints of
    /// hairstyles.
    enum class By { own, regions, values, stretch, area, angle, field };

    By by = By::own;
    /// Attribute of By::values.
    std::string attribute = {};

    bool operator==(const Coloring&) const = default;
};

/// Returns whether it compares shapes.
bool is_distortion(const Coloring& coloring);

/// Returns how a list of choices calls it.
std::string label_of(const Coloring& coloring);

/// Returns the choices for the meshes of `picture`: their own colours, the field if there is one,
/// then regions if they have any, attributes with one number a vertex, and distortion.
std::vector<Coloring> colorings_of(const Picture& picture);

/// The shapes that meshes are compared with: for each mesh of a picture the first of the same faces
/// that was seen in its place.
class RestShapes {
  public:
    using MeshPtr = std::shared_ptr<const Mesh>;

    /// Sees the meshes of the next picture.
    void see(const Picture& picture);
    /// Forgets all shapes, so that the next ones count as the first.
    void forget() { shapes_.clear(); }
    /// One for each mesh of the picture that was seen last.
    const std::vector<MeshPtr>& shapes() const { return shapes_; }

  private:
    std::vector<MeshPtr> shapes_;
};

/// `picture` with its meshes in these colours, and the legend that belongs to them; meshes that
/// have nothing of the kind keep their own. `rest` has one shape a mesh. Errors: cancelled.
Picture colored(Picture picture, const Coloring& coloring,
                const std::vector<RestShapes::MeshPtr>& rest, const Context& context = {});

}  // namespace lissom::window
