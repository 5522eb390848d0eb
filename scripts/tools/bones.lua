--- Lays bones into limbs and bends them, while the surface follows.
--
-- Drag along a limb: a chain of bones lies in the middle of the body below the stroke. Or click joint after
-- joint from the base to the tip, and press Enter; backspace takes the last one back. Then drag the tip, and
-- the chain reaches for the cursor; drag a bone, or a joint between two, and the bone turns, with those
-- behind it; drag the first joint, and the whole chain moves. Limits are kept. With the first chain on a mesh
-- its body is pinned: vertices farther from the bones than `room`, and nearer to the base than to the tip.
--
-- Keys: tab goes to the next chain, r puts the chain back to rest, delete takes it away, f finishes. Bones
-- are handles in the object "... deformation" beside the mesh, and the tool deform knows them.
local bone_chains = require "tools.support.bone_chains"
local handles = require "tools.support.handles"
local lissom = require "lissom"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"
local vectors = require "vectors"

local click_radius = 12         -- pixels

-- The chosen chain, else the last one; its number.
local function active(self, list)
    for i, chain in ipairs(list) do
        if chain.bones == self.bones then return chain, i end
    end
    return list[#list], #list
end

-- Takes hold of a part of a chain.
local function hold(self, ev, under)
    local chain, held = under.chain, { part = under.part, bone = under.bone }
    held.pose = chain.deformer:pose()
    held.joint = chain.joints[under.part == "reach" and #chain.joints or math.max(under.bone, 1)]
    if under.part == "turn" then
        held.last, held.axis = bone_chains.angle_about(ev, held.joint)
        held.angle = 0
    else
        held.offset = vectors.plus(held.joint, bone_chains.beside(ev, held.joint), -1)
    end
    self.bones, self.held = chain.bones, held
end

-- The place of what is held, in the space of the mesh.
local function place_of(held, ev, chain)
    local place = vectors.plus(bone_chains.beside(ev, held.joint), held.offset, 1)
    return matrices.point(matrices.inverse(chain.place), place)
end

local moves = {
    turn = function(held, ev, chain)
        local angle = bone_chains.angle_about(ev, held.joint)
        held.angle = held.angle + (angle - held.last + 540) % 360 - 180
        held.last = angle
        local sign = matrices.mirrors(chain.place) and -1 or 1
        local axis = matrices.direction(matrices.inverse(chain.place), held.axis)
        chain.bones:turn(held.bone, axis, sign * held.angle)
    end,
    reach = function(held, ev, chain)
        local _, way = ev.camera:ray(ev.x, ev.y, ev.size)
        local axis = matrices.direction(matrices.inverse(chain.place), way)
        local left = chain.bones:reach(place_of(held, ev, chain), { axis = axis })
        return left > 1e-3 * chain.mesh:size() and string.format("%.3g from there", left) or nil
    end,
    move = function(held, ev, chain) chain.bones:move(place_of(held, ev, chain)) end,
}

-- Moves what is held, from the pose at the press: only the cursor's place counts. Returns the chain.
local function drag(self, ev)
    local chain = active(self, bone_chains.list(ev.scene))
    if not chain or chain.bones ~= self.bones then return nil end
    chain.deformer:set_pose(self.held.pose)
    self.told = moves[self.held.part](self.held, ev, chain)
    return chain
end

-- The mesh of the clicked joints, if that is there still.
local function clicked(self, scene)
    local one = self.clicks and meshes.find(scene, self.clicks.mesh)
    if not one then self.clicks = nil end
    return one
end

-- Ends a stroke over a mesh: a chain, or one joint of it.
local function finish(self, scene, stroke)
    local one = meshes.find(scene, stroke.mesh)
    if not one then return end
    if stroke.moved then
        local joints = bone_chains.spaced(stroke.points, self.params.bones + 1)
        self.bones, self.clicks = bone_chains.lay(scene, one, joints, self.params), nil
    else
        local on_same = self.clicks and rawequal(self.clicks.mesh, stroke.mesh)
        if not on_same then self.clicks = { mesh = stroke.mesh, points = {} } end
        table.insert(self.clicks.points, stroke.points[1])
    end
end

local keys = {
    enter = function(self, scene)
        local one = clicked(self, scene)
        if not one or #self.clicks.points < 2 then
            error("click two joints at least, or drag along a limb", 0)
        end
        self.bones, self.clicks = bone_chains.lay(scene, one, self.clicks.points, self.params), nil
    end,
    backspace = function(self, scene) if clicked(self, scene) then table.remove(self.clicks.points) end end,
    tab = function(self, _, _, number, list)
        self.bones = #list > 0 and list[number % #list + 1].bones or nil
    end,
    r = function(_, _, chain)
        if not chain then return end
        chain.bones:reset()
        chain.deformer:solve()
    end,
    delete = function(self, scene, chain)
        if not chain then return end
        chain.bones:remove()
        self.bones = nil
        for _, one in ipairs(handles.list(scene)) do
            if rawequal(one.mesh, chain.mesh) and not one.pinned then return chain.deformer:solve() end
        end
        meshes.end_deformation(scene, chain.mesh)
    end,
    f = function(_, scene, chain) if chain then meshes.end_deformation(scene, chain.mesh) end end,
}

-- Draws points of a mesh and the line through them.
local function draw_line(view, mesh, points)
    local one, places = meshes.find(view.scene, mesh), {}
    if not one or #points == 0 then return end
    for i, point in ipairs(points) do places[i] = matrices.point(one.place, point) end
    if #places > 1 then view:line{ points = places, color = "#1878c0", width = 3 } end
    view:points{ points = places, color = "#1878c0", radius = 4 }
end

local function let_go(self) self.held, self.stroke, self.told = nil, nil, nil end

return lissom.tool{
    name = "bones",
    help = "Drag along a limb, or click joints, then Enter. Drag the tip (reach), a bone (turn), the first "
        .. "joint (move). Keys: backspace, tab, r(est), delete, f(inish).",
    params = {
        preview = { type = "choice", default = "large meshes", choices = { "large meshes", "always",
            "never" }, help = "Drags are quick, with some shear, and exact when they end." },
        bones = { type = "integer", default = 3, min = 1, max = 30, group = "next chain",
            help = "Bones of a stroke." },
        limit = { type = "number", default = 180, min = 0, max = 180, unit = "degrees",
            group = "next chain", help = "How far a bone may turn from rest; 180: everywhere." },
        room = { type = "number", default = 1, min = 0, max = 10, unit = "first bones",
            group = "next chain", help = "Farther from the bones the body is pinned; 0: nothing is." },
    },
    press = function(self, ev)
        self.told = nil
        local under = bone_chains.part_under(ev, bone_chains.list(ev.scene))
        if under then return hold(self, ev, under) end
        local hit = ev:hit()
        local one = hit and meshes.find(ev.scene, hit.mesh)
        local point = one and bone_chains.middle(ev, one)
        if point then self.stroke = { mesh = one.mesh, points = { point }, start = { ev.x, ev.y } } end
    end,
    drag = function(self, ev)
        if self.held then
            local chain = drag(self, ev)
            if chain and not ev.late then handles.preview(chain, self.params.preview) end
            return
        end
        local one = self.stroke and meshes.find(ev.scene, self.stroke.mesh)
        if not one then return end
        local far = bone_chains.pixels(self.stroke.start, { ev.x, ev.y }) > click_radius
        self.stroke.moved = self.stroke.moved or far
        table.insert(self.stroke.points, bone_chains.middle(ev, one))
    end,
    release = function(self, ev)
        local stroke, told = self.stroke, nil
        if self.held then
            local chain = drag(self, ev)
            if chain then chain.deformer:solve() end
            told = self.told
        end
        let_go(self)
        self.told = told
        if stroke then finish(self, ev.scene, stroke) end
    end,
    key = function(self, ev)
        if self.held or self.stroke or not keys[ev.key] then return end
        self.told = nil
        local list = bone_chains.list(ev.scene)
        local chain, number = active(self, list)
        keys[ev.key](self, ev.scene, chain, number, list)
    end,
    draw = function(self, view)
        local list = bone_chains.list(view.scene)
        local chosen = active(self, list)
        for _, one in ipairs(handles.list(view.scene)) do
            local color = one.pinned and "#6f7b8c" or "#8860c8"
            view:region{ mesh = one.mesh, region = one.handle:region(), color = color }
        end
        for _, chain in ipairs(list) do
            local color = chain == chosen and "#e8a33d" or "#8860c8"
            view:line{ points = chain.joints, color = color, width = 4 }
            view:points{ points = chain.joints, color = color, radius = 5 }
            view:handle{ at = chain.joints[#chain.joints], color = color }
        end
        if self.clicks then draw_line(view, self.clicks.mesh, self.clicks.points) end
        if self.stroke then draw_line(view, self.stroke.mesh, self.stroke.points) end
        if self.told and chosen then
            view:label{ at = chosen.joints[#chosen.joints], text = self.told }
        end
    end,
    cancel = let_go,
    deactivate = function(self)
        let_go(self)
        self.clicks, self.bones = nil, nil
    end,
}
