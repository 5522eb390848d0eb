-- Hair stays outside of heads, on its side of a parting, and goes through the tie of a ponytail, on any head.
local lissom = require "lissom"
local models = require "models"
local ponytails = require "ponytails"
local strokes = require "strokes"

local count = 2000

-- Declares a test for each head.
local function on_heads(name, check)
    test(name .. ", generated", function() check(lissom.shapes.head{}) end)
    for _, file in ipairs{ "ict_head.obj", "makehuman_head.obj", "LeePerrySmith.glb",
        "hairstep_usc_head.obj" } do
        test(name .. ", " .. file, function() check(assert(lissom.load(models.path("heads/" .. file)))) end)
    end
end

-- Hardly anything deeper in the head than half a millimetre, between points too; no damage, no sharp turn.
local function expect_sound(style, hair)
    local stats = hair:stats{ style = style }
    expect.truthy(stats.penetrating <= 0.002 * #hair)
    expect.equal(stats.not_finite, 0)
    expect.equal(stats.zero_segments, 0)
    expect.equal(stats.sharp, 0)
end

local settings = {
    {},
    { height = 50, length = 0.34, tightness = 0.8, fullness = 0.9, droop = 0.11 },
    { height = -12, length = 0.26, tightness = 0.4, droop = 0.02 },
    { height = 6, side = 0.75, length = 0.28, tightness = 0.5, droop = 0.035 },
    { height = 30, length = 0.15, tightness = 0.6, fullness = 0.9, droop = 0.065 },
}

local function parted(head)
    local style = lissom.hairstyle(head)
    local route, by = strokes.route(style), strokes.by
    style:add_dividing{ points = route{ { 0, 37 }, { 0, 55 }, { 0, 76 } } }
    strokes.both_sides({
        { { 20, 46, 14 }, { 52, 34, 18 }, { 71, 8, 18 }, by(4, -50, -4), by(-4, -60, -4) },
        { { 30, 72, 14 }, { 70, 50, 18 }, { 92, 5, 22 }, by(5, -50, 0), by(-4, -60, 0) },
        { { 130, 68, 12 }, { 126, 32, 20 }, { 126, -5, 22 }, by(2, -50, 0), by(-2, -60, 0) },
    }, function(places) style:add_stream{ points = route(places) } end)
    return style
end

-- Of strands rooted within 2 cm of the line in the middle of the head: the share that crosses it within 3 cm.
local function crossing_share(style, hair)
    local scalp = style:scalp()
    local unit, near, crossed = scalp:unit(), 0, 0
    for i = 1, #hair do
        local strand = hair:strand(i)
        local function place(k)
            local x, y, z = strand:get(k)
            return scalp:to_metres(x / unit, y / unit, z / unit)
        end
        local root = place(1)
        if math.abs(root[1]) < 0.02 and root[2] > 0.07 and root[3] > 0.02 then
            near = near + 1
            for k = 2, strand:count() do
                local p = place(k)
                local d = (p[1] - root[1]) ^ 2 + (p[2] - root[2]) ^ 2 + (p[3] - root[3]) ^ 2
                if d > 0.03 ^ 2 then break end
                if p[1] * root[1] < 0 then
                    crossed = crossed + 1
                    break
                end
            end
        end
    end
    expect.truthy(near > 50)
    return crossed / near
end

-- Fraction of strands that lie on the skin beside an ear, or over it.
local function over_ears(style, hair)
    local scalp, found = style:scalp(), 0
    local unit = scalp:unit()
    for i = 1, #hair do
        local strand = hair:strand(i)
        for k = 2, strand:count() do
            local x, y, z = strand:get(k)
            local p = scalp:to_metres(x / unit, y / unit, z / unit)
            local level = math.sqrt(p[1] ^ 2 + p[3] ^ 2)
            local azimuth, elevation = math.deg(math.acos(p[3] / level)), math.deg(math.atan(p[2] / level))
            if azimuth > 89 and azimuth < 105 and math.abs(elevation + 12) < 7 and level < 0.12 then
                found = found + 1
                break
            end
        end
    end
    return found / #hair
end

-- The widest gap between strands of a tail 12 cm below its tie, from front to back, in metres; without the
-- outermost of them.
local function widest_gap(style, hair, tie)
    local scalp, depths = style:scalp(), {}
    local unit = scalp:unit()
    local place = { azimuth = tie.azimuth, elevation = tie.elevation, lift = tie.lift }
    local top = scalp:to_metres(scalp:at(place))
    for i = 1, #hair do
        local strand, last = hair:strand(i), nil
        for k = 1, strand:count() do
            local x, y, z = strand:get(k)
            local p = scalp:to_metres(x / unit, y / unit, z / unit)
            if last and last[2] > top[2] - 0.12 and p[2] <= top[2] - 0.12 and p[3] < top[3] + 0.02 then
                depths[#depths + 1] = p[3]
                break
            end
            last = p
        end
    end
    expect.truthy(#depths > 0.5 * #hair)
    table.sort(depths)
    local gap = 0
    for i = math.ceil(0.002 * #depths) + 1, math.floor(0.998 * #depths) do
        gap = math.max(gap, depths[i] - depths[i - 1])
    end
    return gap
end

on_heads("no hair hangs in front of a low tail by itself", function(head)
    for _, height in ipairs{ 0, 12 } do
        local style, hair, tie = ponytails.grow(head, { height = height }, {}, { count = count })
        expect.truthy(widest_gap(style, hair, tie) < 0.004)
    end
end)

on_heads("a low ponytail leaves the ears free", function(head)
    for _, low in ipairs{ { height = -15, tightness = 0.2 }, { height = -10 } } do
        local style, hair = ponytails.grow(head, low, {}, { count = count })
        expect.truthy(over_ears(style, hair) < 0.003)
    end
end)

on_heads("high tails fall, and take the hair of the nape along", function(head)
    local _, high, tail = ponytails.grow(head, { height = 50, tightness = 1 }, {}, { count = count })
    expect.truthy(#high:select{ group = "ponytail" } > 0.98 * #high)
    expect.truthy(tail.droop < 0.06)
end)

on_heads("hair goes through loose ties, too, and does not stop in front of them", function(head)
    local loose = { height = -5, side = 0.75, length = 0.25, tightness = 0 }
    local style, hair = ponytails.grow(head, loose, {}, { count = count })
    expect.truthy(#hair:select{ group = "ponytail" } > 0.93 * #hair)
    expect_sound(style, hair)
end)

on_heads("ponytails of all kinds are sound", function(head)
    for _, setting in ipairs(settings) do
        local style, hair = ponytails.grow(head, setting, {}, { count = count })
        expect.truthy(#hair:select{ group = "ponytail" } > 0.98 * #hair)
        expect_sound(style, hair)
    end
end)

on_heads("hair stays on its side of a parting", function(head)
    local style = parted(head)
    local hair = style:grow{ count = count, length = 0.2 }
    expect.truthy(crossing_share(style, hair) < 0.005)
    expect_sound(style, hair)
end)

-- One strand of a thousand may lie in the head.
test("an engine finds no fault with the presets: roots, guides, points, places", function()
    local head = lissom.shapes.head{ vertices = 3000 }
    for _, name in ipairs{ "afro", "bob", "braid", "bun", "buzz", "centre_part", "cornrows", "crop",
        "crown_braid", "half_up", "high_ponytail", "locs", "long_straight", "messy", "mohawk", "pigtails",
        "pixie", "ponytail", "ringlets", "side_part", "slick_back", "spiky", "topknot", "two_braids",
        "undercut", "waves" } do
        local preset = require("presets." .. name)
        local style, hair = preset.grow(head, {}, { count = 1500, resolution = 8000 })
        for _, finding in ipairs(hair:check{ target = "unreal", head = style }.findings) do
            local is_rare = finding.code == "inside_head" and finding.count <= 0.001 * #hair
            expect.truthy(is_rare, name .. ": " .. finding.code .. " " .. finding.count)
        end
    end
end)
