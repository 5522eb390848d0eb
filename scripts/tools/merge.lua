--- Merges two meshes along an open boundary of each: a coroutine answers the clicks.
--
-- Click the loop of the part that is moved, then the loop that it is joined to: the merged surface appears
-- there, instead of the second mesh, and a label says how it was placed, how certain that is, and whether
-- the seam is good. If it is turned wrongly, turn it by the wheel, with ctrl or while the button is down,
-- or click pairs of points that shall meet, the first on the loop of the part, the second on the seam; or
-- choose which of the world's axes is up on the part as it lies, and which way it looks: arrows show these
-- hints on both meshes, and are dragged to any direction, with ctrl along an axis. Enter takes the result,
-- and the part is hidden too. The parameters may be changed until the next merge: the result follows.
local lissom = require "lissom"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"
local vectors = require "vectors"

local pick = lissom.pick
local step = 5                      -- of a line of the wheel, in degrees
local colors = { up = "#30a040", front = "#c03080" }

local axes = { x = { 1, 0, 0 }, ["-x"] = { -1, 0, 0 }, y = { 0, 1, 0 }, ["-y"] = { 0, -1, 0 },
    z = { 0, 0, 1 }, ["-z"] = { 0, 0, -1 } }
local of_part = { "none", "x", "-x", "y", "-y", "z", "-z" }
local of_other = { "the same", "x", "-x", "y", "-y", "z", "-z" }

-- The hint "up" or "front": a direction of the world on the part, and the one on the other mesh that it goes
-- to; nil if there is none. Directions that were `dragged` come before those of the parameters.
local function hint(params, dragged, name)
    local of_source = "part_" .. name
    if params[of_source] == "none" then return nil end
    local source = dragged[of_source] or axes[params[of_source]]
    return source, dragged[name] or axes[params[name]] or source
end

-- The hints as options of lissom.merge: in the space of the target, in which the part lies as in the scene.
local function with_hints(options, params, scene, join)
    local back = matrices.inverse(scene:info(join.target.object).transform)
    for _, name in ipairs{ "up", "front" } do
        local source, target = hint(params, join.dragged, name)
        if source then
            options["source_" .. name] = matrices.direction(back, source)
            options["target_" .. name] = matrices.direction(back, target)
        end
    end
    return options
end

-- The rotation that a matrix of a scene holds, or nil if it holds none.
local function rotation_of(m)
    local x = vectors.unit{ m[1][1], m[2][1], m[3][1] }
    local y = { m[1][2], m[2][2], m[3][2] }
    y = vectors.unit(vectors.plus(y, x, -vectors.dot(x, y)))
    local z = vectors.cross(x, y)
    local r = { { x[1], y[1], z[1], 0 }, { x[2], y[2], z[2], 0 }, { x[3], y[3], z[3], 0 }, { 0, 0, 0, 1 } }
    return x[1] + y[2] + z[3] < 3 - 1e-14 and r or nil
end

-- How the part lies beside the other mesh in the scene: its place and size there do not matter.
local function relative_turn(scene, join)
    local from, to = scene:info(join.source.object).transform, scene:info(join.target.object).transform
    return rotation_of(matrices.product(matrices.inverse(to), from))
end

-- The axis and the angle in degrees of a rotation.
local function axis_and_angle(r)
    local axis = { r[3][2] - r[2][3], r[1][3] - r[3][1], r[2][1] - r[1][2] }
    local cosine = (r[1][1] + r[2][2] + r[3][3] - 1) / 2
    if vectors.length(axis) < 1e-6 then             -- half a turn: a column of r + 1 is the axis
        axis = { r[1][1] + 1, r[2][1], r[3][1] }
        if vectors.length(axis) < 0.5 then axis = { r[1][2], r[2][2] + 1, r[3][2] } end
        if vectors.length(axis) < 0.5 then axis = { r[1][3], r[2][3], r[3][3] + 1 } end
    end
    return axis, math.deg(math.acos(math.max(-1, math.min(1, cosine))))
end

-- The loop of the part on a copy that is turned as it lies in the scene.
local function turned_source(source, turn)
    if not turn then return source.boundary end
    local axis, angle = axis_and_angle(turn)
    local copy = source.mesh:copy():transform{ rotate = { axis = axis, angle = angle } }
    return copy:boundaries()[source.index]
end

local function moved_keys(keys, turn)
    local moved = {}
    for i, pair in ipairs(keys) do
        moved[i] = { turn and matrices.direction(turn, pair[1]) or pair[1], pair[2] }
    end
    return moved
end

-- The point of a loop at a fraction of its length.
local function point_at(loop, fraction)
    local points, length = loop:points(), loop:length()
    local left = fraction % 1 * length
    for i, p in ipairs(points) do
        local edge = vectors.plus(points[i % #points + 1], p, -1)
        local step_length = vectors.length(edge)
        if left <= step_length then
            return vectors.plus(p, edge, step_length > 0 and left / step_length or 0)
        end
        left = left - step_length
    end
    return points[1]
end

-- Keys whose ends on the target go around it, counter-clockwise seen against the opening. The loop has the
-- surface on its left, so that it runs the other way.
local function turned_keys(target, keys, angle)
    local turned = {}
    for i, pair in ipairs(keys) do
        local at = target:nearest(pair[2]).parameter
        turned[i] = { pair[1], point_at(target, at - angle / 360) }
    end
    return turned
end

-- Text about a join: the criterion of the part's rotation, its certainty, the verdict.
local function told(join, report)
    local found, words = report.joins[1], {}
    table.insert(words, found.placed == "keys" and "placed by keys" or "placed: " .. found.placed)
    if found.certainty and join.turn == 0 then
        table.insert(words, string.format("certainty %.2f", found.certainty))
    end
    if found.any_turn then table.insert(words, "any turn fits") end
    if join.turn ~= 0 then table.insert(words, string.format("turned by %g degrees", join.turn)) end
    return table.concat(words, "; ") .. "\n" .. report.verdict
end

-- Merges. A join is { source =, target =, keys =, turn =, dragged = }: hits of two loops, pairs of points on
-- them, degrees, and directions of hints by their names.
local function merged(self, scene, join)
    for _, hit in ipairs{ join.source, join.target } do
        local there = rawequal(meshes.get(scene, hit.object), hit.mesh)
        if not there then error(hit.object .. " is no longer there", 0) end
    end
    local turn = relative_turn(scene, join)
    local source, target = turned_source(join.source, turn), join.target.boundary
    local radii = self.params.transition
    local function width(loop) return radii * loop:length() / (2 * math.pi) end
    local function merge(keys)
        return lissom.merge(with_hints({
            joins = { { source = source, target = target, keys = #keys > 0 and keys or nil } },
            transition = radii > 0 and { source = width(source), target = width(target) } or nil,
            place = self.params.place ~= "as placed" and self.params.place or nil,
        }, self.params, scene, join))
    end
    local keys = moved_keys(join.keys, turn)
    local mesh, report = merge(keys)
    if join.turn == 0 then return mesh, report end
    local placed = report.joins[1].placed
    if #keys == 0 then keys = { report.joins[1].key } end
    mesh, report = merge(turned_keys(target, keys, join.turn))
    report.joins[1].placed = placed
    return mesh, report
end

-- Shows the result of a join, in place of the one before or of the target.
local function show(self, scene, join)
    local mesh, report = merged(self, scene, join)
    local before = self.result and meshes.info(scene, self.result)
    if before then
        scene:remove(self.result)
    else
        self.result = meshes.unused_name(scene, "merged")
        scene:set(join.target.object, { visible = false })
    end
    scene:add(self.result, mesh, { transform = scene:info(join.target.object).transform })
    -- For the colours of the window; by ids, which a journal can tell.
    for _, name in ipairs{ "seam", "transition" } do
        local region = report[name].region
        if region then mesh:set_region(name, mesh:region{ vertices = region:vertices() }) end
    end
    join.told = told(join, report)
    join.warnings = report.warnings
    self.joins[mesh:hash()] = join
end

-- A point of a loop in the scene, or nil once it is gone.
local function in_scene(scene, loop)
    local info = meshes.info(scene, loop.object)
    return info and matrices.point(info.transform, loop.boundary:points()[1])
end

-- The same join with another turn, and other directions of hints if they are given.
local function with_turn(join, turn, dragged)
    return { source = join.source, target = join.target, keys = join.keys, turn = turn,
        dragged = dragged or join.dragged }
end

-- Directions of hints with another one under a name, or without it.
local function with_direction(dragged, name, direction)
    local copy = {}
    for key, value in pairs(dragged) do copy[key] = value end
    copy[name] = direction
    return copy
end

-- Joins likewise; a failure is shown in the picture, and the clicks go on.
local function try(self, scene, join)
    local done, message = pcall(show, self, scene, join)
    message = not done and tostring(message):gsub("^%S+:%d+: ", ""):gsub(" %[[%l_]+%]$", "")
    self.trouble = message and { at = join.target.position, text = message } or nil
end

-- The join that is shown, which undo changes too; nil if there is none.
local function shown(self, scene)
    local mesh = self.result and meshes.object(scene, self.result)
    return mesh and self.joins[mesh:hash()]
end

-- The same, as long as the result is not taken: the part is still to be seen.
local function in_progress(self, scene)
    local join = shown(self, scene)
    local source = join and meshes.info(scene, join.source.object)
    return source and source.visible and join
end

-- The point of a loop that was clicked, in the space of its mesh.
local function on_loop(scene, loop, hit)
    local place = scene:info(loop.object).transform
    return loop.boundary:nearest(matrices.point(matrices.inverse(place), hit.position)).position
end

-- Draws a loop and the keys on it, the first or second of each pair.
local function draw_loop(view, loop, keys, which, color)
    local info = loop and meshes.info(view.scene, loop.object)
    if not info then return end
    local points = {}
    for i, point in ipairs(loop.boundary:points()) do points[i] = matrices.point(info.transform, point) end
    view:line{ points = points, closed = true, color = color, width = 4 }
    for number, pair in ipairs(keys) do
        local at = pair[which] and matrices.point(info.transform, pair[which])
        if at then view:handle{ at = at, color = color } end
        if at then view:label{ at = at, text = tostring(number) } end
    end
end

-- The hints as arrows at the middle of a loop, as long as 1.5 of its radius: a list of { name =, center =,
-- length =, tip =, color = }; `which` is 1 for the part and 2 for the other mesh.
local function arrows(scene, params, dragged, loop, which)
    local info, list = loop and meshes.info(scene, loop.object), {}
    if not info then return list end
    local center, points = { 0, 0, 0 }, loop.boundary:points()
    for i, point in ipairs(points) do
        points[i] = matrices.point(info.transform, point)
        center = vectors.plus(center, points[i], 1 / #points)
    end
    local length = 1.5 * vectors.length(vectors.plus(points[1], center, -1))
    for _, name in ipairs{ "up", "front" } do
        local direction = select(which, hint(params, dragged, name))
        if direction then
            table.insert(list, { name = which == 1 and "part_" .. name or name, center = center,
                length = length, tip = vectors.plus(center, vectors.unit(direction), length),
                color = colors[name], label = name })
        end
    end
    return list
end

local near_tip = 12             -- pixels from which the tip of an arrow is taken hold of

-- The arrow whose tip is under the cursor, of both loops of a join.
local function arrow_under(self, ev, join)
    for which, loop in ipairs{ join.source, join.target } do
        for _, arrow in ipairs(arrows(ev.scene, self.params, join.dragged, loop, which)) do
            local x, y = ev.camera:project(arrow.tip, ev.size)
            if math.abs(x - ev.x) + math.abs(y - ev.y) <= near_tip then return arrow end
        end
    end
    return nil
end

-- The direction from the middle of an arrow to the cursor's place on the ball around it, or nearest to it;
-- with ctrl the nearest axis of the world.
local function dragged_to(ev, arrow)
    local origin, sight = ev:ray()
    local off = vectors.plus(origin, arrow.center, -1)
    local along = -vectors.dot(off, sight)
    local nearest = vectors.plus(off, sight, along)
    local beside = arrow.length ^ 2 - vectors.dot(nearest, nearest)
    local direction = vectors.unit(vectors.plus(nearest, sight, -math.sqrt(math.max(0, beside))))
    if not ev.ctrl then return direction end
    local best
    for _, axis in pairs(axes) do
        if not best or vectors.dot(axis, direction) > vectors.dot(best, direction) then best = axis end
    end
    return best
end

local function draw_arrows(view, list)
    for _, arrow in ipairs(list) do
        view:line{ points = { arrow.center, arrow.tip }, color = arrow.color, width = 4 }
        view:handle{ at = arrow.tip, color = arrow.color }
        view:label{ at = arrow.tip, text = arrow.label }
    end
end

return lissom.tool{
    name = "merge",
    help = "Click two loops; turn the part by the wheel, by hints, or click points that meet; Enter takes.",
    params = {
        place = { type = "choice", default = "as placed", choices = { "as placed", "shape" },
            help = "Without keys: turned least from how the part lies, or as the shapes of both suggest." },
        part_up = { type = "choice", default = "none", choices = of_part, group = "hints",
            help = "Up direction of the part as it lies, if it has no keys." },
        up = { type = "choice", default = "the same", choices = of_other, group = "hints",
            help = "The way that is up on the mesh that it is joined to." },
        part_front = { type = "choice", default = "none", choices = of_part, group = "hints",
            help = "View direction of the part as it lies, if it has no keys." },
        front = { type = "choice", default = "the same", choices = of_other, group = "hints",
            help = "The way that the mesh looks that it is joined to." },
        transition = { type = "number", default = 0, min = 0, max = 2, unit = "radii of the loop",
            help = "Width on either side of the seam in which the details of both fade into each other." },
    },
    joins = {},             -- by the hash of their result
    run = function(self, ev)
        local scene = ev.scene
        self.open = nil
        while not in_progress(self, scene) do           -- after undo it may be: then keys are asked for
            self.source = nil
            self.source = pick.boundary{
                prompt = "Click the loop of the part that is moved (the box 'boundaries' shows all)" }
            self.result = nil
            local target = pick.boundary{ prompt = "Click the loop that it is joined to" }
            try(self, scene, { source = self.source, target = target, keys = {}, turn = 0, dragged = {} })
        end
        local join = shown(self, scene)
        while join do
            local from = pick.boundary{
                prompt = "Enter takes it, ctrl and the wheel turn it; or click a point of the part's loop",
                object = join.source.object, optional = true }
            if not from then return scene:set(join.source.object, { visible = false }) end
            self.open = { on_loop(scene, join.source, from) }
            local to = pick.point{ prompt = "Click its place on the seam", object = self.result }
            join = shown(self, scene) or join           -- arrows may have been dragged
            local keys = table.move(join.keys, 1, #join.keys, 1, {})
            table.insert(keys, { self.open[1], on_loop(scene, join.target, to) })
            self.open = nil
            try(self, scene, { source = join.source, target = join.target, keys = keys, turn = 0,
                dragged = join.dragged })
            join = shown(self, scene)
        end
    end,
    press = function(self, ev)
        local join = in_progress(self, ev.scene)
        self.arrow = join and arrow_under(self, ev, join) or nil
        return self.arrow ~= nil
    end,
    drag = function(self, ev) self.arrow.direction = dragged_to(ev, self.arrow) end,
    release = function(self, ev)
        local arrow, join = self.arrow, in_progress(self, ev.scene)
        self.arrow = nil
        if not (join and arrow.direction) then return end
        try(self, ev.scene, with_turn(join, 0, with_direction(join.dragged, arrow.name, arrow.direction)))
    end,
    wheel = function(self, ev)
        local join = in_progress(self, ev.scene)
        if not join then return end
        local turn = (join.turn + step * ev.lines + 180) % 360 - 180
        try(self, ev.scene, with_turn(join, turn))
    end,
    changed = function(self, ev)
        local join = shown(self, ev.scene)
        if not join then return end
        try(self, ev.scene, with_turn(join, join.turn, with_direction(join.dragged, ev.parameter, nil)))
    end,
    draw = function(self, view)
        if self.trouble then view:label(self.trouble) end
        local join = in_progress(self, view.scene) or { source = self.source, keys = {}, dragged = {} }
        local held, dragged = self.arrow, join.dragged
        if held and held.direction then dragged = with_direction(dragged, held.name, held.direction) end
        local keys = table.move(join.keys, 1, #join.keys, 1, {})
        table.insert(keys, self.open)
        draw_loop(view, join.source, keys, 1, "#d06020")
        draw_arrows(view, arrows(view.scene, self.params, dragged, join.source, 1))
        draw_arrows(view, arrows(view.scene, self.params, dragged, join.target, 2))
        draw_loop(view, join.target, keys, 2, "#2070c0")
        local at = join.told and in_scene(view.scene, join.target)
        if not at then return end
        local lines = { join.told }
        table.move(join.warnings, 1, #join.warnings, 2, lines)
        view:label{ at = at, text = table.concat(lines, "\n") }
    end,
    cancel = function(self, ev)
        local in_a_step = ev.scene:depth() > 0          -- after an error there is none
        local join = in_a_step and in_progress(self, ev.scene)
        if join then
            ev.scene:remove(self.result)
            ev.scene:set(join.target.object, { visible = true })
        end
        self.source, self.trouble, self.arrow = nil, nil, nil
    end,
    deactivate = function(self) self.source, self.trouble, self.arrow = nil, nil, nil end,
}
