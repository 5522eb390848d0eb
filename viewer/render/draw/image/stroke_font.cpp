#include "viewer/render/draw/image/stroke_font.h"

#include <cmath>
#include <sstream>
#include <string>
#include <utility>

namespace lissom {
namespace {

constexpr double kCapitalHeight = 14.0;
constexpr double kLetterGap = 3.0;
constexpr double kSpaceWidth = 3.0;
constexpr double kArcStep = 12.0 * kPi / 180.0;

/// Width and outline of a letter. The outline is a list of: `M x y`, begin a stroke; `L x y`, a
/// line; `A cx cy rx ry from to`, an arc of an ellipse between angles in degrees, joined to the
/// stroke by a line; `B` with the same numbers, an arc that begins a stroke.
struct Letter {
    char letter;
    double width;
    const char* outline;
};

constexpr Letter kLetters[] = {
    {'0', 8, "B 4 7 4 7 0 360"},
    {'1', 8, "M 1.4 11 L 5 14 L 5 0"},
    {'2', 8, "B 4 10 3.8 4 165 -38 L 0 0 L 8 0"},
    {'3', 8, "B 4 10.6 3.5 3.4 155 -90 A 4 3.6 4 3.6 90 -155"},
    {'4', 8, "M 6 0 L 6 14 L 0 4.2 L 8.2 4.2"},
    {'5', 8, "M 7.2 14 L 1.4 14 L 0.9 7.8 A 3.8 4.6 4.1 4.6 128 -150"},
    {'6', 8, "B 4 4.4 4 4.4 0 360 B 7.6 4.4 7.6 9.6 180 98"},
    {'7', 8, "M 0 14 L 8 14 L 2.8 0"},
    {'8', 8, "B 4 10.6 3.4 3.4 0 360 B 4 3.6 4 3.6 0 360"},
    {'9', 8, "B 4 9.6 4 4.4 0 360 B 0.4 9.6 7.6 9.6 0 -82"},
    {'A', 10, "M 0 0 L 5 14 L 10 0 M 1.7 4.8 L 8.3 4.8"},
    {'B', 8.8,
     "M 4.5 7.2 L 0 7.2 L 0 14 L 4.5 14 A 4.5 10.6 3.6 3.4 90 -90 A 4.9 3.6 3.9 3.6 90 -90 "
     "L 0 0 L 0 7.2"},
    {'C', 10, "B 6 7 6 7 48 312"},
    {'D', 9.5, "M 0 0 L 0 14 L 3.5 14 A 3.5 7 6 7 90 -90 L 0 0"},
    {'E', 7.5, "M 7.5 14 L 0 14 L 0 0 L 7.5 0 M 0 7.2 L 6.5 7.2"},
    {'F', 7.5, "M 7.5 14 L 0 14 L 0 0 M 0 7 L 6.5 7"},
    {'G', 11, "B 6 7 6 7 48 312 L 10.6 6.6 L 6.6 6.6"},
    {'H', 9, "M 0 0 L 0 14 M 9 0 L 9 14 M 0 7.2 L 9 7.2"},
    {'I', 0, "M 0 0 L 0 14"},
    {'J', 5.5, "M 5.5 14 L 5.5 3.5 A 2.5 3.5 3 3.5 0 -160"},
    {'K', 8.5, "M 0 0 L 0 14 M 8 14 L 0 5.5 M 2.8 8.5 L 8.5 0"},
    {'L', 7, "M 0 14 L 0 0 L 7 0"},
    {'M', 11, "M 0 0 L 0 14 L 5.5 4 L 11 14 L 11 0"},
    {'N', 9, "M 0 0 L 0 14 L 9 0 L 9 14"},
    {'O', 12, "B 6 7 6 7 0 360"},
    {'P', 8.4, "M 0 0 L 0 14 L 4.6 14 A 4.6 10.2 3.8 3.8 90 -90 L 0 6.4"},
    {'Q', 12, "B 6 7 6 7 0 360 M 7.5 3.6 L 11 -0.8"},
    {'R', 8.6, "M 0 0 L 0 14 L 4.6 14 A 4.6 10.2 3.8 3.8 90 -90 L 0 6.4 M 4.4 6.4 L 8.6 0"},
    {'S', 8.5, "B 4.3 10.6 3.7 3.4 38 270 A 4.3 3.6 4.1 3.6 90 -145"},
    {'T', 9, "M 0 14 L 9 14 M 4.5 14 L 4.5 0"},
    {'U', 8.8, "M 0 14 L 0 4.5 A 4.4 4.5 4.4 4.5 180 360 L 8.8 14"},
    {'V', 9.6, "M 0 14 L 4.8 0 L 9.6 14"},
    {'W', 14, "M 0 14 L 3.6 0 L 7 11 L 10.4 0 L 14 14"},
    {'X', 8.6, "M 0 0 L 8.6 14 M 0 14 L 8.6 0"},
    {'Y', 9, "M 0 14 L 4.5 7 L 9 14 M 4.5 7 L 4.5 0"},
    {'Z', 8, "M 0 14 L 8 14 L 0 0 L 8 0"},
    {'a', 8, "B 4 5 4 5 0 360 M 8 10 L 8 0"},
    {'b', 8, "M 0 14.5 L 0 0 B 4 5 4 5 0 360"},
    {'c', 7.2, "B 4.4 5 4.4 5 50 310"},
    {'d', 8, "B 4 5 4 5 0 360 M 8 14.5 L 8 0"},
    {'e', 8.3, "M 0.2 5.2 L 8.3 5.2 A 4.2 5 4.1 5 2 312"},
    {'f', 4.6, "B 4 11.5 2.6 3 60 180 L 1.4 0 M -0.4 9.6 L 4.6 9.6"},
    {'g', 8, "B 4 5 4 5 0 360 M 8 10 L 8 -1 A 4.2 -1 3.8 3.5 0 -150"},
    {'h', 7.6, "M 0 14.5 L 0 0 M 0 6 A 3.8 6 3.8 4 180 0 L 7.6 0"},
    {'i', 0, "M 0 10 L 0 0 M 0 13.8 L 0 14"},
    {'j', 2, "M 2 10 L 2 -2 A 0 -2 2 2.4 0 -90 M 2 13.8 L 2 14"},
    {'k', 7, "M 0 14.5 L 0 0 M 6.5 10 L 0 4 M 2.4 6.2 L 7 0"},
    {'l', 0, "M 0 14.5 L 0 0"},
    {'m', 12, "M 0 10 L 0 0 M 0 6.6 A 3 6.6 3 3.4 180 0 L 6 0 M 6 6.6 A 9 6.6 3 3.4 180 0 L 12 0"},
    {'n', 7.6, "M 0 10 L 0 0 M 0 6 A 3.8 6 3.8 4 180 0 L 7.6 0"},
    {'o', 8.6, "B 4.3 5 4.3 5 0 360"},
    {'p', 8, "M 0 10 L 0 -4.5 B 4 5 4 5 0 360"},
    {'q', 8, "B 4 5 4 5 0 360 M 8 10 L 8 -4.5"},
    {'r', 4.8, "M 0 10 L 0 0 M 0 6 A 3.8 6 3.8 4 180 70"},
    {'s', 6.5, "B 3.3 7.6 2.9 2.4 38 270 A 3.3 2.6 3.2 2.6 90 -145"},
    {'t', 4.8, "M 1.6 13 L 1.6 3 A 4 3 2.4 3 180 290 M -0.2 9.6 L 4.8 9.6"},
    {'u', 7.6, "M 0 10 L 0 4 A 3.8 4 3.8 4 180 360 M 7.6 10 L 7.6 0"},
    {'v', 7.6, "M 0 10 L 3.8 0 L 7.6 10"},
    {'w', 12, "M 0 10 L 3 0 L 6 9 L 9 0 L 12 10"},
    {'x', 7, "M 0 0 L 7 10 M 0 10 L 7 0"},
    {'y', 7.6, "M 0 10 L 3.8 0 M 7.6 10 L 2.2 -4.5"},
    {'z', 6.8, "M 0 10 L 6.8 10 L 0 0 L 6.8 0"},
    {'.', 0, "M 0 0.1 L 0 0.3"},
    {',', 0.6, "M 0.6 0.3 L -0.4 -2.4"},
    {':', 0, "M 0 1 L 0 1.2 M 0 8.6 L 0 8.8"},
    {';', 0.6, "M 0.6 1.2 L -0.4 -1.6 M 0.6 8.6 L 0.6 8.8"},
    {'-', 5.4, "M 0 6 L 5.4 6"},
    {'_', 8, "M 0 -2 L 8 -2"},
    {'+', 8, "M 0 6 L 8 6 M 4 2 L 4 10"},
    {'=', 8, "M 0 4 L 8 4 M 0 8 L 8 8"},
    {'/', 5.5, "M 0 -1.5 L 5.5 15.5"},
    {'\\', 5.5, "M 0 15.5 L 5.5 -1.5"},
    {'(', 2.2, "B 5 6 5 10 125 235"},
    {')', 2.2, "B -2.8 6 5 10 55 -55"},
    {'[', 2.5, "M 2.5 16 L 0 16 L 0 -3 L 2.5 -3"},
    {']', 2.5, "M 0 16 L 2.5 16 L 2.5 -3 L 0 -3"},
    {'%', 12, "B 2.6 11 2.4 3 0 360 B 9.4 3 2.4 3 0 360 M 10 14 L 2 0"},
    {'*', 6, "M 3 14 L 3 8 M 0.4 12.5 L 5.6 9.5 M 5.6 12.5 L 0.4 9.5"},
    {'\'', 0, "M 0 14.5 L 0 11"},
    {'"', 2.8, "M 0 14.5 L 0 11 M 2.8 14.5 L 2.8 11"},
    {'#', 10, "M 1 0 L 4 14 M 6 0 L 9 14 M 0 4.5 L 9 4.5 M 1 9.5 L 10 9.5"},
    {'<', 7, "M 7 11 L 0 6 L 7 1"},
    {'>', 7, "M 0 11 L 7 6 L 0 1"},
    {'!', 0, "M 0 14 L 0 4 M 0 0.1 L 0 0.3"},
    {'?', 7.2, "B 3.6 10.6 3.6 3.4 165 -50 L 3.6 6.2 L 3.6 4 M 3.6 0.1 L 3.6 0.3"},
    {'|', 0, "M 0 15.5 L 0 -3"},
    {'^', 7, "M 0 9 L 3.5 14 L 7 9"},
};

constexpr Letter kUnknown{'\0', 8, "M 0 0 L 8 0 L 8 14 L 0 14 L 0 0"};

const Letter& letter_for(char c) {
    for (const Letter& letter : kLetters) {
        if (letter.letter == c) return letter;
    }
    return kUnknown;
}

struct Arc {
    Vec2 center, radii;
    double from, to;
};

Arc read_arc(std::istream& outline) {
    Arc arc{};
    outline >> arc.center.x() >> arc.center.y() >> arc.radii.x() >> arc.radii.y() >> arc.from >>
        arc.to;
    arc.from *= kPi / 180.0;
    arc.to *= kPi / 180.0;
    return arc;
}

void append_arc(const Arc& arc, Stroke& stroke) {
    const int steps = static_cast<int>(std::ceil(std::abs(arc.to - arc.from) / kArcStep));
    for (int i = 0; i <= steps; ++i) {
        const double angle = arc.from + (arc.to - arc.from) * i / steps;
        stroke.push_back(arc.center +
                         arc.radii.cwiseProduct(Vec2(std::cos(angle), std::sin(angle))));
    }
}

std::vector<Stroke> trace(const Letter& letter) {
    std::vector<Stroke> strokes;
    std::istringstream outline(letter.outline);
    for (char command = 0; outline >> command;) {
        if (command == 'M' || command == 'B') strokes.emplace_back();
        if (command == 'A' || command == 'B') {
            append_arc(read_arc(outline), strokes.back());
        } else {
            Vec2 point;
            outline >> point.x() >> point.y();
            strokes.back().push_back(point);
        }
    }
    return strokes;
}

bool continues_character(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0) == 0x80;
}

}  // namespace

TextStrokes lay_out_text(std::string_view text, double height) {
    const double scale = height / kCapitalHeight;
    TextStrokes result;
    double x = 0.0;
    bool first = true;
    for (const char c : text) {
        if (continues_character(c)) continue;
        if (!std::exchange(first, false)) x += kLetterGap;
        if (c == ' ') {
            x += kSpaceWidth;
            continue;
        }
        const Letter& letter = letter_for(c);
        for (Stroke& stroke : trace(letter)) {
            for (Vec2& point : stroke) point = scale * (point + Vec2(x, 0.0));
            result.strokes.push_back(std::move(stroke));
        }
        x += letter.width;
        result.width = scale * x;
    }
    return result;
}

}  // namespace lissom
