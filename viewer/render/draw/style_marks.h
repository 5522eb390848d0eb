/// A hairstyle's curves, their constraints on its field, and the field itself, as lines of a
/// picture.
#pragma once

#include <optional>
#include <vector>

#include "kernel/hair/hairstyle.h"
#include "viewer/render/draw/drawing.h"
#include "viewer/render/draw/image/color.h"
#include "viewer/render/draw/legend.h"

namespace lissom {

/// Plane on which the field is shown. Lengths and directions are those of the style: metres of the
/// scalp's frame.
struct FieldSlice {
    Vec3 point = Vec3::Zero();
    /// Normal of any length but 0; by default the plane is the middle of the head across.
    Vec3 normal = Vec3::UnitX();
    /// Between neighbouring arrows; absent: the step of the grid.
    std::optional<double> spacing = std::nullopt;
};

/// Parts of a style that are shown.
struct StyleMarks {
    /// Its curves: streams cyan, dividing curves red, spines and cross sections of ponytails
    /// purple; disabled ones grey.
    bool curves = true;
    /// Arrows at the grid points that curves constrain, in the colours of Figures 4.4 and 4.5 of
    /// the thesis: along streams, spines and partings blue; at ends and partings of hair red; cross
    /// sections purple; into the tie green; those of avoid_scalp grey.
    bool constraints = false;
    /// Arrows of the field; they are as long as it, and stand outside the head.
    std::optional<FieldSlice> field = std::nullopt;
    /// The box that the field fills, in the field's colour.
    bool volume = false;
    Color field_color{0.16, 0.22, 0.34};
    /// Width of curves, in pixels; arrows have a third of it.
    double width = 4.0;
};

/// Returns the lines of a style that was solved, in the coordinates of its head. Errors:
/// invalid_argument for a spacing or normal out of range, or one that gives more than a million
/// arrows.
std::vector<DrawnLine> style_lines(const Hairstyle& style, const StyleMarks& marks = {});

/// Meaning of the colours of its arrows.
std::vector<LegendPart> style_legend(const Hairstyle& style, const StyleMarks& marks);

/// Marks that a picture can show, with names for its legend.
struct NamedMarks {
    std::vector<DrawnLine> lines = {};
    std::vector<LegendPart> names = {};
};

/// Figure 4.2 of the thesis: the constraints of a style and its bounding volume, and if it was
/// solved its field in the middle of the head, from the front to the back, in a colour that reads
/// on dark and on light.
NamedMarks field_marks(const Hairstyle& style);

}  // namespace lissom
