---@meta _
-- Made from the registration table; do not edit.

---Pictures.
---@class lissom
local lissom = {}

---@class lissom.RenderOptions.Hair
---@field color? string Colour of all strands, instead of their own. Default: the strands' own, else a brown.
---@field level? number Part of the strands to draw, the first of them; the fewer, the wider each, so that they cover as much. Default: 1.
---@field count? integer The same as a number of strands. Default: all.
---@field unit? number Length of the mesh's unit; strands are in metres. In metres. Default: that of the places of the roots on the mesh, else 1.
---@field primary? number Strength of the white reflection. Default: 0.14.
---@field primary_exponent? number Its sharpness. Default: 26.
---@field primary_shift? number Its lean towards the tip; negative: to the root. In degrees. Default: 5.73.
---@field secondary? number Strength of the coloured reflection. Default: 0.42.
---@field secondary_exponent? number Its sharpness. Default: 10.
---@field secondary_shift? number Its lean towards the tip; negative: to the root. In degrees. Default: -8.594.
---@field shift_jitter? number Random lean of reflections, by strand. In degrees. Default: 2.865.
---@field strand_tone? number Random difference of strands' brightness. Default: 0.12.
---@field clump_tone? number The same for clumps of strands with neighbouring roots. Default: 0.1.
---@field clump_size? number Distance of the middles of these clumps at the roots. In metres. Default: 0.005.
---@field root_tone? number Factor of the colour at the root. Default: 0.72.
---@field tip_tone? number Factor of the colour at the tip. Default: 1.18.
---@field shadow? number Strength of the shadows of strands on each other and on meshes; 0: none. Default: 1.
---@field scalp_tint? number Part of the hair's colour that the scalp takes at dense roots. Default: 0.7.

---@class lissom.RenderOptions.Style_marks
---@field curves? boolean Draws the curves. Default: true.
---@field constraints? boolean Draws style:constraints() as arrows: along streams, spines and partings blue, at ends and partings of hair red, around tails purple, into ties green, those of avoid_scalp grey. Default: false.
---@field field? boolean Draws the field as arrows on a plane through the volume. Default: false.
---@field legend? boolean Explains the colours of arrows at the right. Default: false.
---@field point? lissom.Vector A point of the plane. In mesh units. Default: the center of the head.
---@field normal? lissom.Vector Normal of the plane. Default: the head's left.
---@field spacing? number Between neighbouring arrows. In metres. Default: a step of the grid.

---@class lissom.RenderOptions
---@field mesh? lissom.Mesh The mesh to draw; may be left out if strands are drawn.
---@field meshes? lissom.Mesh[] Several meshes to draw, instead of `mesh`.
---@field scene? lissom.Scene A scene to draw instead: its visible objects at their places, by their styles.
---@field offsets? lissom.Vector[] Moves each mesh by a vector, in the picture only.
---@field columns? integer 0: all meshes in one space. Else each in a cell of its own, this many a row, all seen by the same camera. Default: 0.
---@field fit? "all"|"each" In cells, a view frames all meshes at one scale, or each by itself. Default: all.
---@field captions? string[] In cells, a line of text below each mesh.
---@field color? string|string[] Colour of the meshes: "#rrggbb" or one of white, black, gray, lightgray, darkgray, clay, red, orange, yellow, green, teal, blue, purple, sand; with "#rrggbbaa" they are seen through, the less so the greater aa is. Default: clay.
---@field vertex_colors? boolean Draws the attribute "color" if a mesh has it. Default: true.
---@field shading? "smooth"|"flat" flat shows the faces. Default: "smooth".
---@field crease? number Smooth shading keeps edges sharp if faces meet at more than this angle. In degrees. Default: 50.
---@field wire? boolean Draws the edges of the faces. Default: false.
---@field wire_width? number Their width. In pixels. Default: 1.
---@field strands? lissom.Strands|lissom.Strands[] Hair to draw, in metres. It hides paths and points.
---@field hair? lissom.RenderOptions.Hair Appearance of the strands. Light goes through them by their colour: dual scattering (Zinke et al. 2008).
---@field style? lissom.Hairstyle A hairstyle whose curves to draw: streams cyan, dividing curves red, ponytails purple. Without a mesh or strands on its head.
---@field style_marks? lissom.RenderOptions.Style_marks Drawn parts of the style.
---@field region? lissom.Region|string The region of interest, drawn in blue.
---@field regions? boolean|string[] Named regions, drawn each in a colour of its own, with a legend; the smaller of overlapping ones.
---@field handles? string[]|lissom.Region[] Handles, drawn in purple; single vertices as balls.
---@field boundaries? boolean Draws the open boundaries, each in a colour of its own. Default: false.
---@field paths? lissom.Path[] Paths to draw as lines.
---@field points? lissom.Vector[] Points to draw as balls.
---@field line_width? number Width of boundaries and paths; balls are three times as wide. In pixels. Default: 4.
---@field scalars? string|lissom.Buffer|number[] Numbers to draw in the colours of a scale.
---@field range? number[] {low, high}: the numbers at the ends of the scale. Default: the least and the greatest.
---@field legend? boolean Draws the scale with its numbers. Default: true.
---@field label? string Stands above the scale. Default: the name of the scalars.
---@field file string The picture to write; its name ends with .png.
---@field size? integer|integer[] {width, height} of the picture in pixels; one number for a square. Default: {1280, 960}.
---@field camera? lissom.Camera Camera of the picture, instead of `view`.
---@field background? string A colour as for `color`, or "transparent". Default: "white".
---@field samples? integer Samples a pixel along edges of meshes: 1, 2, 4, ... as far as the driver has them. Default: 4.
---@field supersample? integer Pixels drawn along each side of one in the picture; 2 is for print. Default: 1.
---@field occlusion? number Darkness of folds and contacts; 0 draws faster. Default: 1.
---@field view? "front"|"back"|"left"|"right"|"top"|"bottom"|"three-quarter" The side to look from, of the world and not of the object: with y upwards the camera stands at +z for front, -z for back, +x for right, -x for left. For a head that faces +z, as is usual, left shows its own right side. three-quarter stands between front and right, and above. Default: three-quarter.
---@field up? "y"|"z" The axis that points up in the view. Default: y.
---@field parallel? boolean Without perspective. Default: false.
---@field margin? number Share of the picture left free on every side. Default: 0.06.

---Draws meshes and hair into a picture file. Needs no window and no display.
---@param options lissom.RenderOptions
---@return string file # The file that was written.
function lissom.render(options) end

---@class lissom.Bake_cardsOptions
---@field cards lissom.Cards Cards that strands:cards made.
---@field file? string The colours as .png; alpha is steep about `cutoff`. Default: none.
---@field flow? string As .png, like a normal map: direction towards the tip across (red) and from tip to root (green), height over the card of -5 to 5 mm (blue). Default: none.
---@field data? string As .png: 0 at the root to 1 at the tip (red), a number of the strand (green), covered part of the texel (blue). Default: none.
---@field mesh? string The cards as .glb with colours and flow inside. Default: none.
---@field across? integer Faces of the preview, and ribbons, across each card. Default: 24.
---@field size? integer Texels along each side. Default: 2048.
---@field cutoff? number Alpha below it is not drawn. Default: 0.5.
---@field color? string Colour of all strands, instead of their own. Default: the strands' own, else a brown.
---@field strand_tone? number Random difference of strands' brightness. Default: 0.12.
---@field clump_tone? number The same for clumps of strands with neighbouring roots. Default: 0.1.
---@field root_tone? number Factor of the colour at the root. Default: 0.72.
---@field tip_tone? number Factor of the colour at the tip. Default: 1.18.

---Bakes the pictures of hair cards, without light: colour with alpha, flow and data, and saves the cards with them. Needs no display.
---@param options lissom.Bake_cardsOptions
---@return lissom.Mesh preview # The cards without what is clear, as faces of the colours of their parts, for renderers without textures such as lissom.render.
---@return lissom.Strands ribbons # The cards without the cap and without what is clear, as strands along them in the colours of their parts: lissom.render lights them as hair.
---@return lissom.Mesh cap # The cap alone, as in `preview`.
function lissom.bake_cards(options) end

return lissom
