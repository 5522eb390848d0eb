--- Hair gathered at one tie and its tail, for presets: ponytails, and the hair of braids and buns before they
-- are made.
--
--     local ponytails = require "ponytails"
--     local style, hair, tie = ponytails.grow(head, { height = 30, length = 0.15 })
local hairdo = require "hairdo"
local lissom = require "lissom"
local styling = require "styling"

local ponytails = {}

--- The parameters of a ponytail, as lissom.params takes them.
ponytails.schema = {
    height = { type = "number", default = 6, min = -15, max = 50, unit = "degrees",
        help = "elevation of the tie; 0 is level with the middle of the head" },
    side = { type = "number", default = 0, min = -1, max = 1,
        help = "0 behind, 1 at the left, -1 at the right" },
    tightness = { type = "number", default = 0.7, min = 0, max = 1,
        help = "how closely hair lies to the head" },
    length = { type = "number", default = 0.3, min = 0.05, max = 0.6, unit = "metres",
        help = "behind the tie" },
    fullness = { type = "number", default = 1.1, min = 0, max = 2, help = "how much the tail swells" },
    lift = { type = "number", default = 0.02, min = 0.015, max = 0.03, unit = "metres",
        help = "how far the tie stands off the head" },
    droop = { type = "number", default = -1, min = -1, max = 0.3, unit = "metres",
        help = "length over which the tail bends down; below 0: by the height" },
    gather = { type = "integer", default = 10, min = 3, max = 24, help = "streams that lead into the tie" },
    seed = { type = "integer", default = 1, min = 1, help = "chance" },
}

-- Values of all parameters: those given, else the defaults. An unknown name is an error.
local function complete(values)
    local all = {}
    for name, one in pairs(ponytails.schema) do all[name] = one.default end
    for name, value in pairs(values or {}) do
        if all[name] == nil then
            lissom.error{ message = "the ponytail has no parameter '" .. name .. "'", level = 3 }
        end
        all[name] = value
    end
    return all
end

-- Length over which a tail bends down: one at the crown stands up before it falls. In a bend narrower than
-- the tie, hair at the tie's lower edge would fall in front of the tail, by itself; at the side of the head
-- most hair comes from above.
local function droop_at(height, side)
    local knots = { { -90, 0.024, 0.02 }, { -15, 0.024, 0.02 }, { 0, 0.034, 0.02 }, { 30, 0.04, 0.04 },
        { 50, 0.05, 0.05 }, { 90, 0.05, 0.05 } }
    local f = math.abs(side)
    local function droop(knot) return (1 - f) * knot[2] + f * knot[3] end
    for i = 2, #knots do
        local a, b = knots[i - 1], knots[i]
        if height <= b[1] then
            return droop(a) + (droop(b) - droop(a)) * (height - a[1]) / (b[1] - a[1])
        end
    end
    return droop(knots[#knots])
end

-- A low tie draws hair from the temples over the ears: first it goes up and over them.
local over_ears = {
    { { 69, 4 }, { 77, 14 }, { 88, 22 }, { 104, 24 }, { 121, 17 } },
    { { 52, 24 }, { 80, 33 }, { 108, 30 }, { 128, 17 } },
}
-- A high tail falls in front of the nape, whose hair goes up to the tie.
local from_nape = {
    { { 180, -38 }, { 180, -20 } }, { { 158, -36 }, { 160, -20 } }, { { 134, -22 }, { 138, -8 } },
}

-- Routes on both sides of the head, as far as they do not run past a tie at `azimuth`.
local function on_both_sides(routes, azimuth)
    local list = {}
    local function add(route, sign)
        local places = {}
        for _, place in ipairs(route) do
            local past = sign * azimuth > 0 and place[1] < 180 and place[1] > math.abs(azimuth) - 10
            if not past then places[#places + 1] = { sign * place[1], place[2] } end
        end
        if #places > 0 then list[#list + 1] = places end
    end
    for _, route in ipairs(routes) do
        add(route, 1)
        if route[1][1] < 180 then add(route, -1) end
    end
    return list
end

--- Returns the curves of a ponytail on a head, and its tail as in hairdo.ring. `options` are those of
-- lissom.hairstyle.
function ponytails.style(head, values, options)
    values = complete(values)
    local all = {}
    for key, value in pairs(options or {}) do all[key] = value end
    all.scalp = all.scalp or styling.scalp(head)
    local tie = { azimuth = 180 - 75 * values.side, elevation = values.height, lift = values.lift,
        length = values.length,
        droop = values.droop >= 0 and values.droop or droop_at(values.height, values.side),
        radius = 0.016 + 0.010 * (1 - values.tightness) }
    hairdo.keep_off_ears(all.scalp, tie)
    -- Towards the end of its spine a tail narrows to a wick: hair ends before.
    tie.length = 1.1 * values.length
    local spine = hairdo.tail_spine(all.scalp, tie)
    -- Hair that leaves the volume is cut off flat at its faces.
    local room = 0.02 + 1.2 * tie.radius * (1 + values.fullness)
    all.volume = all.volume or hairdo.volume(all.scalp, room, spine)
    all.gravity = all.gravity or 0
    local style = lissom.hairstyle(head, all)
    local low = 0.002 + 0.012 * (1 - values.tightness)
    hairdo.gather(style, tie, { count = values.gather, reach = 0.08, low = low })
    local azimuth = (tie.azimuth + 180) % 360 - 180
    if values.height < 20 then
        hairdo.lead(style, tie, { routes = on_both_sides(over_ears, azimuth), low = low })
    end
    if values.height > 5 then
        hairdo.lead(style, tie, { routes = on_both_sides(from_nape, 180), low = low })
    end
    style:add_ponytail{
        spine = spine,
        radius = tie.radius,
        fullness = values.fullness,
        share = 0.75,
        -- At a low tie, hair that enters at its lower edge is sparse: spread more, it would part from the
        -- tail.
        spread = 0.5 + math.min(math.max((values.height - 12) / 20, 0), 1),
        -- If the tail hangs free of the head its end is seen: tips of like lengths would end it bluntly.
        ragged = 0.3 + 0.1 * math.min(math.max((values.height - 30) / 20, 0), 1),
        tail_length = values.length,
        name = "ponytail",
    }
    return style, tie
end

-- Ends hair that runs along the tail but missed its ring at the end of the tail. On it would gather on the
-- spine to a thin string.
local function loose_ends(scalp, tie)
    local spine = hairdo.tail_spine(scalp, tie)
    local tip = spine[math.max(2, math.floor(#spine / 1.1))]
    local before = spine[math.max(1, math.floor(#spine / 1.1) - 2)]
    local along = {}
    for k = 1, 3 do along[k] = tip[k] - before[k] end
    return { point = tip, normal = along, ragged = 0.03 }
end

--- Returns the style, its hair and its tail. `options` are those of lissom.hairstyle, and the `count` of
-- strands as in presets; with `hard` the edge of the hair stays as it is. `growth` are options of style:grow.
function ponytails.grow(head, values, options, growth)
    values = complete(values)
    local of_style = {}
    for key, value in pairs(options or {}) do of_style[key] = value end
    of_style.count, of_style.hard = nil, nil
    local style, tie = ponytails.style(head, values, of_style)
    local all = { count = options and options.count, length = 0.6, seed = values.seed,
        layer = 0.003 + 0.014 * (1 - values.tightness), cut = loose_ends(style:scalp(), tie) }
    for key, value in pairs(growth or {}) do all[key] = value end
    local hair = styling.set_width(style:grow(all), 0.00022)
    if not (options and options.hard) then styling.soften(style, hair, "tied", values.seed) end
    return style, hair, tie
end

--- Winds hair that was gathered at a tie to a bun on it, of a `radius` to the middle of its ring. `options`
-- are further ones of hair:bun.
function ponytails.wind(hair, scalp, tie, radius, options)
    local at = { azimuth = tie.azimuth, elevation = tie.elevation, lift = tie.lift }
    local all = { center = scalp:at(at), direction = scalp:normal_at(at), scalp = scalp, radius = radius,
        reach = 2.2 * tie.radius }
    for key, value in pairs(options) do all[key] = value end
    return hair:smooth{ iterations = 3 }:bun(all)
end

return ponytails
