local lissom = require "lissom"

local head = lissom.shapes.head{ vertices = 3000 }
local scalp = lissom.scalp(head)
local on, normal = scalp:at{ azimuth = 90, elevation = 30 }, scalp:normal_at{ azimuth = 90, elevation = 30 }

local function bald_style()
    return lissom.hairstyle(head, { scalp = scalp, resolution = 6000 })
end

-- A style of three curves for each test; the ponytail is not enabled.
local style, stream, parting, pony

local function at(azimuth, elevation, lift)
    return style:at{ azimuth = azimuth, elevation = elevation, lift = lift or 0 }
end

test.before(function()
    style = bald_style()
    local side = { at(20, 50, 0.01), at(70, 25, 0.02), at(85, -15, 0.02) }
    stream = style:add_stream{ points = side, name = "side" }
    local middle = { at(0, 45), at(0, 65), at(0, 85) }
    parting = style:add_dividing{ points = middle, tilt = { 10, 30 }, gap = 0.01 }
    local tie = at(180, 25, 0.02)
    pony = style:add_ponytail{
        spine = { tie, { tie[1], tie[2], tie[3] - 0.04 }, { tie[1], tie[2] - 0.15, tie[3] - 0.06 } },
        name = "pony",
        enabled = false,
    }
end)

test("the scalp is that of the head", function()
    expect.equal(#scalp:region(), #head:region("scalp"))
    expect.equal(scalp:guessed(), false)
    expect.truthy(scalp:head() == head)
end)

test("how sure the guess is", function()
    expect.truthy(scalp:confidence() > 0.8)
    expect.equal(scalp:doubt(), "")
    expect.truthy(scalp:knows_unit())
    local heard = {}
    lissom.listen{ log = function(level, message) heard[#heard + 1] = level .. ": " .. message end }
    local left = head:cut{ plane = { point = { 0, 0, 0 }, normal = { 1, 0, 0 }, seed = { 0.07, 0.03, 0 } } }
    local doubtful = lissom.scalp(left)
    expect.truthy(doubtful:confidence() < 0.5 and #doubtful:doubt() > 0)
    local huge = lissom.scalp(head:copy():transform{ scale = 3 })
    expect.equal(huge:knows_unit(), false)
    lissom.listen{}
    local all = table.concat(heard, "; ")
    expect.truthy(all:find("warning: place and direction of the head"))
    expect.truthy(all:find("unit of the head is not known"))
end)

test("points over the head, in mesh units; lifts in metres", function()
    local above = scalp:at{ azimuth = 90, elevation = 30, lift = 0.02 }
    local rise = 0
    for k = 1, 3 do rise = rise + (above[k] - on[k]) * normal[k] end
    expect.near(rise, 0.02, 1e-3)
    expect.near(scalp:from_metres(scalp:to_metres(on)), on, 1e-12)
    expect.error(function() scalp:at{ elevation = 30 } end, "azimuth")
    expect.truthy(style:head() == head)
    expect.equal(#bald_style():curves(), 0)
    expect.error(function() lissom.hairstyle(head, { resolution = 6000000000 }) end, "resolution")
    expect.error(function() lissom.hairstyle(head, { tenshun = 1 }) end, "tenshun")
end)

test("growing without curves is a mistake of the script, as a stream without points is", function()
    local bald = bald_style()
    expect.error(function() bald:grow{ count = 10 } end, "add a curve")
    expect.error(function() bald:add_stream{ points = { { 0, 0, 0 } } } end, "two points")
end)

test("curves keep their identity", function()
    expect.equal(#style:curves(), 3)
    expect.truthy(style:curves()[2] == parting)
    expect.equal(stream:kind() .. parting:kind() .. pony:kind(), "streamdividingponytail")
    expect.equal(stream:name(), "side")
    expect.equal(pony:enabled(), false)
    expect.equal(tostring(stream), "lissom.Curve: stream 'side', 3 points")
    expect.truthy(stream:hairstyle() == style)
    expect.near(stream:points()[1], at(20, 50, 0.01), 1e-9)
    expect.truthy(#stream:course() > 5)
    expect.equal(pony:reorder(1), pony)
    expect.truthy(style:curves()[1] == pony)
end)

test("wrong curves are refused by name, and change nothing", function()
    expect.error(function() style:add_stream{ points = stream:points(), tightness = 1 } end, "tightness")
    expect.error(function() stream:set{ tightness = 1 } end, "tightness")
    expect.error(function() style:add_stream{ points = { at(0, 90) } } end, "differ")
    expect.error(function() parting:set{ tilt = { 1 } } end, "two angles")
    expect.error(function() pony:set{ profiles = { 1, 2 } } end, "profiles")
    expect.error(function() style:add_stream{ points = { { 9, 9, 9 }, { 9, 8, 9 } } } end, "outside")
    expect.error(function()
        style:add_dividing{ points = { { 0, 0.2, 0.2 }, { 0, 0.2, 0.1 } } }
    end, "from the head")
    expect.equal(#style:curves(), 3)
end)

test("hints beside a parting are its tilt, until that is set by numbers", function()
    local own = bald_style()
    local line = own:add_dividing{ points = parting:points(), tilt = { 5, 10 } }
    expect.near({ line:tilt().left.start, line:tilt().right.finish }, { 5, 10 }, 1e-9)
    expect.equal(line:tilt().left.pieces, 0)
    local hint = { at(10, 58), at(20, 66) }
    local told = line:add_hint(hint)
    local side = told.left.pieces > 0 and "left" or "right"
    expect.truthy(told[side].start > 15 and told[side].error < 20)
    expect.near(line:options()[side], { told[side].start, told[side].finish }, 1e-9)
    expect.near(line:hints()[1][2], hint[2], 1e-9)
    local path = os.tmpname()
    own:save(path)
    local again = assert(lissom.load_style(path, head)):curves()[1]
    os.remove(path)
    expect.near(again:tilt()[side].start, told[side].start, 1e-9)
    -- The other side keeps what its hints said, as a number.
    line:set{ [side == "left" and "right" or "left"] = { 1, 2 } }
    expect.equal(#line:hints(), 0)
    expect.near(line:options()[side], { told[side].start, told[side].finish }, 1e-9)
    line:add_hint(hint)
    line:set{ gap = 0.004 }
    expect.equal(#line:hints(), 1)
    expect.equal(line:remove_hints(), line)
    expect.truthy(line:tilt()[side].pieces == 0)
    expect.error(function() line:add_hint{ at(180, 0), at(180, 10) } end, "beside")
    expect.error(function() stream:add_hint(hint) end, "only a dividing curve")
    expect.error(function() line:tie() end, "only a ponytail")
    own:close()
    expect.error(function() line:tilt() end, "")
end)

test("the options of a curve are those that act, and go back into set", function()
    for _, curve in ipairs{ stream, parting, pony } do
        local options = curve:options()
        curve:set(options)
        for name, value in pairs(curve:options()) do expect.near(value, options[name], 1e-9) end
    end
end)

test("at returns a point alone, so that its calls fill lists of points; normal_at the normal", function()
    local place = { azimuth = 70, elevation = 10 }
    local points = { at(20, 50), style:at(place) }
    expect.equal(#points, 2)
    local curve = style:add_stream(points, { name = "from calls" })
    expect.near(curve:points()[2], style:at(place), 1e-9)
    expect.near(style:normal_at(place), style:scalp():normal_at(place), 0)
    expect.equal(select("#", style:normal_at(place)), 1)
    curve:remove()
end)

test("the field follows the curves", function()
    local function along(curve)
        local course = curve:course()
        local k = math.floor(#course / 2)
        local v = style:field(course[k])
        local t, length = {}, 0
        for d = 1, 3 do
            t[d] = course[k + 1][d] - course[k][d]
            length = length + t[d] ^ 2
        end
        return (v[1] * t[1] + v[2] * t[2] + v[3] * t[3]) / math.sqrt(length)
    end
    -- On this coarse grid the parting nearby turns it a little.
    expect.truthy(along(stream) > 0.85)
    local _, distance = style:field(on)
    expect.near(distance, 0, 0.004)
    stream:set_points{ at(20, 50, 0.01), at(60, 45, 0.02), at(100, 35, 0.02) }
    expect.truthy(along(stream) > 0.9)
    expect.truthy(style:stats().constraints > 50)
end)

test("hair: as many strands as asked; the first of more are the same", function()
    local hair = style:grow{ count = 600, length = 0.1, seed = 3 }
    expect.equal(#hair, 600)
    expect.equal(hair:stats().not_finite, 0)
    expect.equal(hair:stats().zero_segments, 0)
    -- A coarse grid cannot hold an ear.
    expect.truthy(hair:stats{ style = style }.penetrating <= 3)
    expect.equal(hair:stats{ style = style, depth = -1 }.penetrating, #hair)
    expect.equal(hair:stats().penetrating, nil)
    -- What is inside counts against the surface, however wide the steps of the grid are.
    local under, counts = {}, {}
    for i, lift in ipairs{ -0.002, -0.001, 0.001 } do
        for azimuth = 0, 1 do under[#under + 1] = at(40 + azimuth, 60, lift) end
        counts[i] = 2
    end
    local buried = lissom.strands{ points = under, counts = counts }:stats{ style = style }
    expect.equal(buried.penetrating, 2)
    expect.near(buried.deepest, 0.002, 3e-4)
    expect.equal(hair:hash(), style:grow{ count = 900, length = 0.1, seed = 3 }:select{ first = 600 }:hash())
    expect.truthy(hair:hash() ~= style:grow{ count = 600, length = 0.1, seed = 4 }:hash())
    local root = hair:root(7)
    expect.near(root.bary[1] + root.bary[2] + root.bary[3], 1, 1e-5)
    expect.equal(#root.uv, 2)
    expect.equal(root.group, nil)
    expect.near(root.position, { hair:strand(7):get(1) }, 0)
    expect.truthy(rawequal(style:grow{ count = 100, into = hair }, hair))
    expect.equal(#hair, 100)
    expect.equal(#style:grow{ count = 0 }, 0)
end)

test("where and how long, by functions, lists and attributes", function()
    local function roots_above(options, height)
        local share = style:grow(options):select{ where = function(_, _, y) return y > height end }
        return #share / options.count
    end
    local function upper(_, _, y) return y > 0.08 and 1 or 0 end
    expect.near(roots_above({ count = 500, density = upper }, 0.07), 1, 0.01)
    local short = {}
    for v = 1, #head do short[v] = 0.5 end
    local half = style:grow{ count = 300, length = 0.1, lengths = short }:stats().mean_length
    expect.near(half / style:grow{ count = 300, length = 0.1 }:stats().mean_length, 0.5, 0.05)
    local function text() return "x" end
    expect.error(function() style:grow{ count = 10, density = text } end, "must return a number")
    expect.error(function() style:grow{ count = 10, density = "nothing" } end, "no attribute")
    -- A fringe by length: metres at every vertex, times the factors.
    local function fringe(vertex, _, _, z)
        expect.truthy(vertex >= 1 and vertex <= #head)
        return z > 0.02 and 0.05 or 0.1
    end
    local fringed = style:grow{ count = 300, length = fringe, variation = 0 }
    expect.near(fringed:stats().max_length, 0.1, 2e-3)
    local shortened = style:grow{ count = 300, length = fringe, lengths = short, variation = 0 }
    expect.near(shortened:stats().max_length, 0.05, 1e-3)
    local in_front = fringed:select{ where = function(_, _, _, z) return z > 0.05 end }
    expect.truthy(in_front:stats().max_length < 0.051)
    expect.error(function() style:grow{ count = 10, length = text } end, "must return a number")
    expect.error(function() style:grow{ count = 10, segment = 1e-9 } end, "0.01 to 10")
    expect.error(function() style:grow{ count = 10, length = 50 } end, "at most")
    expect.error(function() pony:set{ radius = 5 } end, "at most")

    local plane = { point = scalp:from_metres(0, 0, 0), ragged = 0 }
    local cut = style:grow{ count = 500, length = 0.3, cut = plane }
    expect.truthy(cut:bounds().min[2] < 0.001)
end)

test("ponytails name their group", function()
    pony:enable()
    for _, azimuth in ipairs{ 50, 90, 130, -50, -90, -130 } do
        local points = { at(azimuth, 45, 0.01), at(180, 40, 0.012), at(180, 26, 0.02) }
        style:add_stream{ points = points, stop = false }
    end
    local tail = style:grow{ count = 400, length = 0.4 }
    expect.equal(table.concat(tail:groups()), "pony")
    expect.truthy(#tail:select{ group = "pony" } > 40)
    expect.equal(#tail:select{ region = scalp:region() }, #tail)
    expect.equal(#tail:select{ region = head:region("bottom") }, 0)
    local near = #tail:select{ near = { curve = pony, radius = 0.01 } }
    expect.truthy(near > 20 and near < 400)
end)

test("hints", function()
    stream:set_points{ at(20, 50, 0.01), at(60, 45, 0.02), at(100, 35, 0.02) }
    local before = #stream:course()
    local points = stream:points()
    stream:cut{ { points[2][1], points[2][2] + 0.02, points[2][3] }, points[2] }
    expect.truthy(#stream:course() < before)
    local cut_length = #stream:course()
    local tip = stream:points()[#stream:points()]
    stream:concatenate{ tip, { tip[1] + 0.01, tip[2] - 0.06, tip[3] } }
    expect.truthy(#stream:course() > cut_length)
    -- A hint that is too far away names the reach, which can be given.
    local far = { { tip[1], tip[2], tip[3] + 0.05 }, { tip[1], tip[2] - 0.03, tip[3] + 0.08 } }
    expect.error(function() stream:cut(far) end, "set reach")
    expect.truthy(stream:cut(far, { reach = 0.2 }) == stream)
    expect.error(function() stream:cut(far, { join = 0.1 }) end, "join")
    expect.error(function() stream:insert{ { 0, -0.3, 0.1 }, { 0, -0.35, 0.1 } } end, "curve")

    local from = stream:points()[2]
    local operation, sure = stream:hint_operation{ { from[1] + 0.02, from[2] + 0.03, from[3] },
        { from[1] - 0.02, from[2] - 0.03, from[3] } }
    expect.truthy(operation == "cut" or operation == "concatenate")
    expect.equal(type(sure), "boolean")
    local last = stream:points()[#stream:points()]
    local stroke = { last, { last[1] + 0.01, last[2] - 0.03, last[3] } }
    expect.equal(stream:hint_operation(stroke), "concatenate")
    expect.error(function() stream:hint_operation({ { 0, -0.3, 0.1 }, { 0, -0.35, 0.1 } }) end, "near")
    expect.error(function() stream:hint_operation(stroke, { near = 0 }) end, "near")
end)

test("what the curves give the field", function()
    pony:enable()
    local kinds = {}
    for _, one in ipairs(style:constraints()) do
        kinds[one.kind] = (kinds[one.kind] or 0) + 1
        expect.truthy(one.curve and style:curves()[one.curve]:enabled())
    end
    expect.truthy(kinds.stream and kinds.parting and kinds.separation and kinds.section and kinds.gather)
    style:avoid_scalp()
    local scalp_count = 0
    for _, one in ipairs(style:constraints()) do
        if one.kind == "scalp" then
            scalp_count = scalp_count + 1
            expect.equal(one.curve, nil)
        end
    end
    expect.truthy(scalp_count > 10)
    style:forget_scalp()
    expect.error(function() style:grow{ count = 10, max_turn = 200 } end, "max_turn")
    local bent = style:grow{ count = 300, max_turn = 180 }:stats().mean_length
    expect.truthy(bent > style:grow{ count = 300, max_turn = 5 }:stats().mean_length)
end)

test("a style and its file", function()
    local file = test.file("style.json")
    pony:enable()
    style:save(file, { head = "head.obj" })
    local copy = lissom.load_style(file, head)
    expect.equal(#copy:curves(), #style:curves())
    expect.equal(copy:grow{ count = 200 }:hash(), style:grow{ count = 200 }:hash())
    expect.failure("file_not_found", lissom.load_style, file)
    local broken = assert(io.open(file, "w"))
    broken:write('{ "format": "lissom hairstyle", "version": 1, "curvs": [] }')
    broken:close()
    expect.truthy(expect.failure("file_syntax", lissom.load_style, file, head).message:find("curvs"))
    -- Values that no curve can have are the file's mistake, which is told with its name.
    style:save(file)
    local read = assert(io.open(file))
    local whole = read:read("a")
    read:close()
    local written = assert(io.open(file, "w"))
    local changed, times = whole:gsub('"weight": [%d.e+-]+', '"weight": 1e99', 1)
    expect.equal(times, 1)
    written:write(changed)
    written:close()
    local problem = expect.failure("file_syntax", lissom.load_style, file, head)
    expect.equal(problem.file, file)
    expect.truthy(problem.message:find(file, 1, true) and problem.message:find("weight", 1, true))
end)

test("removed curves and closed styles refuse to work", function()
    parting:remove()
    expect.equal(tostring(parting), "lissom.Curve (removed)")
    expect.error(function() parting:points() end, "removed")
    style:close()
    expect.error(function() style:grow{} end, "closed")
    expect.error(function() stream:points() end, "closed")
end)

test("a map by a function that gives no number is named by its option", function()
    local mapped = lissom.hairstyle(head, { scalp = scalp, resolution = 6000 })
    for _, name in ipairs{ "length", "density", "lengths" } do
        local wrong = "bad option '" .. name .. "' of 'grow' (its function must return a number, not string"
        expect.error(function() mapped:grow{ count = 10, [name] = function() return "x" end } end, wrong)
    end
end)

-- A head without a region of its own.
local function bare()
    local copy = head:copy()
    copy:remove_region("scalp")
    return copy
end

-- Share of the hairy vertices for which keeps(azimuth, elevation) is true, of those of the head.
local function hairy(skin, keeps)
    local positions, count = skin:head():positions(), 0
    for _, v in ipairs(skin:region():vertices()) do
        local p = skin:to_metres(positions[3 * v - 2], positions[3 * v - 1], positions[3 * v])
        local r = math.sqrt(p[1] ^ 2 + p[2] ^ 2 + p[3] ^ 2)
        local azimuth = math.deg((rawget(math, "atan2") or math.atan)(p[1], p[3]))
        if keeps(azimuth, math.deg(math.asin(p[2] / r))) then count = count + 1 end
    end
    return count
end

test("a hairline is changed by words, by numbers, or by a line drawn on the head", function()
    local plain = lissom.scalp(bare())
    local function front(azimuth) return math.abs(azimuth) < 55 end
    local function middle(azimuth) return math.abs(azimuth) < 8 end
    local function nape(azimuth) return math.abs(azimuth) > 150 end
    local receding = lissom.scalp(bare(), { recession = 0.03 })
    expect.truthy(hairy(receding, front) < hairy(plain, front))
    expect.equal(hairy(receding, nape), hairy(plain, nape))
    local peaked = lissom.scalp(bare(), { peak = 0.03 })
    expect.truthy(hairy(peaked, middle) > hairy(plain, middle))
    expect.truthy(hairy(lissom.scalp(bare(), { nape = -0.03 }), nape) < hairy(plain, nape))
    expect.truthy(#lissom.scalp(bare(), { hairline = { { 0, 60 }, { 180, 10 } } }):region() < #plain:region())
    local line = {}
    for azimuth = -40, 40, 10 do line[#line + 1] = plain:at{ azimuth = azimuth, elevation = 55 } end
    expect.truthy(hairy(lissom.scalp(bare(), { drawn = line }), front) < hairy(plain, front))
    -- Words count before the head's own region.
    expect.equal(lissom.scalp(head, { forehead = 0.01 }):guessed(), true)
    local given = { region = head:region("scalp"), peak = 0.01 }
    expect.error(function() lissom.scalp(head, given) end, "hairline")
    expect.error(function() lissom.scalp(head, { hairline = { { 50, 0 }, { 20, 0 } } }) end, "ascend")
    expect.error(function() lissom.scalp(head, { recession = 1 }) end, "recession")
end)

test("the edge of hair is finer, with baby hair, and far inside it hair stays", function()
    parting:remove()
    local hair = style:grow{ count = 1500, length = 0.1 }
    local before, lengths = hair:hash(), hair:stats()
    hair:soften_edge{ head = style, baby = 0.5, baby_length = 0.02 }
    expect.truthy(hair:hash() ~= before)
    expect.truthy(hair:stats().min_length < 0.5 * lengths.mean_length)
    expect.near(hair:stats().max_length, lengths.max_length, 1e-4)
    expect.equal(#hair, 1500)
    local loose = lissom.strands{ points = { { 0, 0, 0 }, { 0, 0.1, 0 } }, counts = { 2 } }
    expect.error(function() loose:soften_edge{ head = style } end, "no roots")
end)

test("strands of other points take over all that is known of strands", function()
    local hair = style:grow{ count = 5, length = 0.1 }:set_widths{ width = 0.0002 }
    local points, counts = {}, {}
    for s = 1, #hair do
        local at_root = hair:root(s).position
        counts[s] = 2
        points[#points + 1] = at_root
        points[#points + 1] = { at_root[1], at_root[2] - 0.1, at_root[3] }
    end
    local made = lissom.strands{ points = points, counts = counts, like = hair }
    for s = 1, #hair do
        expect.equal(made:root(s).face, hair:root(s).face)
        expect.equal(made:root(s).id, hair:root(s).id)
    end
    made:push_out{ head = style }
    expect.error(function() lissom.strands{ points = { { 0, 0, 0 } }, counts = { 1 }, like = hair } end,
        "one for each new strand")
end)

test("hair of a file whose unit nobody told is told", function()
    local path, heard = test.file("large.hair"), {}
    lissom.strands{ points = { { 0, 0, 0 }, { 0, 20, 0 } }, counts = { 2 } }:save(path)
    lissom.listen{ log = function(_, message) heard[#heard + 1] = message end }
    lissom.load_strands(path)
    expect.truthy(table.concat(heard, ";"):find("unit of the hair is not known"))
    heard = {}
    lissom.load_strands(path, { unit = 0.01 })
    lissom.listen{}
    expect.equal(#heard, 0)
end)
