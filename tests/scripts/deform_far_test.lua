-- A mesh far from the origin of its coordinates deforms as the same mesh brought back from there, to 1e-9
-- of its size, whichever way its handles are moved.
local lissom = require "lissom"

local rest = lissom.shapes.bar{ across = 3, along = 12 }
local size = rest:size()
local offset = { 1e6 * size, -1e6 * size, 1e6 * size }

local function shifted(mesh, sign)
    return mesh:copy():transform{ translate = { sign * offset[1], sign * offset[2], sign * offset[3] } }
end

local function deformed(mesh, shift, move)
    mesh = mesh:copy()
    local deformer = lissom.deformer(mesh)
    deformer:add_handle(mesh:region("bottom"))
    move(deformer:add_handle(mesh:region("top")), shift, deformer)
    assert(deformer:solve())
    return mesh
end

local function compare(move)
    local far = shifted(rest, 1)
    local near = shifted(far, -1)
    local a = shifted(deformed(far, offset, move), -1)
    local b = deformed(near, { 0, 0, 0 }, move)
    local p, q, worst = a:positions(), b:positions(), 0
    for i = 1, #p do worst = math.max(worst, math.abs(p[i] - q[i])) end
    expect.near(worst, 0, 0.5e-9 * size)
end

local function at(shift, x, y, z) return { shift[1] + x, shift[2] + y, shift[3] + z } end

test("deform_far", function()
    compare(function(h) h:rotate{ axis = { 1, 2, 3 }, angle = 70 } end)
    compare(function(h) h:translate(0.7, -0.3, 0.2) end)
    compare(function(h) h:scale{ 1.3, 0.8, 1.1 } end)
    compare(function(h)
        h:set{ translate = { 0.5, 0, 0 }, rotate = { axis = "x", angle = 50 }, scale = 1.2 }
    end)
    compare(function(h)
        for _ = 1, 50 do h:rotate{ axis = { 3, 1, 2 }, angle = 1.5 }:translate(0.01, 0.02, 0):scale(1.002) end
    end)
    compare(function(h, shift)
        h:rotate{ axis = "z", angle = 40, about = at(shift, 1, 2, 0) }
        h:scale(1.1, { about = at(shift, 0, 1, 0) })
        h:set{ rotate = { axis = "x", angle = 50, about = at(shift, 0, 1, 0) }, about = at(shift, 0, 2, 0) }
    end)
    compare(function(h, shift)
        local x, y = shift[1], shift[2]
        h:set_matrix{ { 0, -1, 0, x + y }, { 1, 0, 0, y - x }, { 0, 0, 1, 0.25 }, { 0, 0, 0, 1 } }
    end)
    compare(function(h, shift, deformer)
        local v = deformer:mesh():region("top"):vertices()[1]
        deformer:constrain{ vertex = v - 1, position = at(shift, 0.4, 2.5, 0.1) }
        h:translate(0.1, 0, 0)
    end)
end)

test("there and back is rest, to the bit; a translation adds its offset", function()
    local mesh = shifted(rest, 1)
    local before = mesh:hash()
    local deformer = lissom.deformer(mesh)
    deformer:add_handle(mesh:region("bottom"))
    local top = deformer:add_handle(mesh:region("top"))
    top:rotate{ axis = { 1, 1, 0 }, angle = 35 }
    deformer:solve()
    expect.truthy(mesh:hash() ~= before)
    top:rotate{ axis = { 1, 1, 0 }, angle = -35 }
    deformer:solve()
    expect.equal(mesh:hash(), before)
    local v = mesh:region("top"):vertices()[1]
    local x, y, z = mesh:position(v)
    top:translate(0.125, 0.3, -0.7)
    deformer:solve()
    expect.near({ mesh:position(v) }, { x + 0.125, y + 0.3, z - 0.7 }, 0)
end)
