// The library as WebAssembly, in node:
//     node library_test.mjs FOLDER_OF_LISSOM_WASM [PROGRAM]
// With the program lissom, the scripts of all hosts are compared with it.
// Ends with 77, as a test that is left out, if it was not built.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { openLibrary } from './library.mjs';

const [folder, program] = process.argv.slice(2);
if (!fs.existsSync(path.join(folder, 'lissom.wasm'))) {
    console.log('skipped: the preset wasm was not built');
    process.exit(77);
}
const { module, log, ask, answer, run } = await openLibrary(folder);
const cases = [];
const test = (name, check) => cases.push({ name, check });
const refused = script => { try { run(script); } catch (error) { return error; } return assert.fail('no error'); };

test('a deformed mesh keeps its vertices, and its handle is where it was turned to', () => {
    const { results } = run(`
local lissom = require "lissom"
local bar = lissom.shapes.bar{ length = 4, width = 1, across = 6, along = 24 }
local count, high = bar:vertex_count(), bar:bounds().max[2]
local function slab(from, to) return bar:region{ box = { min = { -9, from, -9 }, max = { 9, to, 9 } } } end
local deformer = lissom.deformer(bar)
deformer:pin(slab(bar:bounds().min[2], bar:bounds().min[2] + 0.1))
deformer:add_handle(slab(high - 0.1, high)):rotate{ axis = "z", angle = 90, about = { 0, 0, 0 } }
deformer:solve()
return bar:vertex_count() == count, bar:bounds().min[1], bar:self_intersections()`);
    assert.equal(results[0], true);
    // The upper end lies at x = -high.
    assert.ok(Math.abs(results[1] + 2) < 1e-3, String(results[1]));
    assert.deepEqual(results[2], []);
});

test('a mesh that changes is read as if it were new, and told from one that does not', () => {
    const { results: [bar] } = run('return require("lissom").shapes.bar{ length = 4, width = 1, across = 4, along = 12 }');
    const bytes = list => module.HEAPU8.slice(module._page_list(list), module._page_list(list) + module._page_list_bytes(list));
    const read = (name, lists) => { ask(name, bar.object, 50); return lists.map(bytes); };
    const [positions, normals, vertices, edges] = [0, 1, 2, 3], all = [positions, normals, vertices, edges];
    const changed = () => { ask('page_read_change', bar.object, 50); return answer(); };
    assert.deepEqual(read('page_read_change', all), read('page_read_mesh', all));
    assert.equal(changed(), 0);
    ask('page_call', 'Mesh.transform', JSON.stringify([{ object: bar.object }, { scale: [1, 2, 1] }]));
    assert.equal(changed(), 1);
    assert.deepEqual([positions, normals].map(bytes), read('page_read_mesh', [positions, normals]));
    ask('page_call', 'Mesh.triangulate', JSON.stringify([{ object: bar.object }]));
    assert.equal(changed(), 2);
    assert.deepEqual(all.map(bytes), read('page_read_mesh', all));
    assert.equal(changed(), 0);
    module._page_forget_mesh(bar.object);
    assert.equal(changed(), 2);
});

test('a head and a cactus merge into one closed surface', () => {
    const { results } = run(`
local lissom = require "lissom"
local head = lissom.shapes.head{ vertices = 3000 }
head = head:cut{ plane = { point = {0, -0.15, 0}, normal = {0, 1, 0}, seed = {0, 0.1, 0} } }
local cactus = lissom.shapes.cactus{ vertices = 3000, ribs = 0 }
cactus = cactus:cut{ plane = { point = {0, 1.7, 0}, normal = {0, -1, 0} } }
local mesh = lissom.merge(head, cactus)
return mesh:is_closed(), mesh:is_manifold(), mesh:genus(), mesh:components()`);
    assert.deepEqual(results, [true, true, 0, 1]);
});

test('hair grows, its lists are as long as they say, and its head gives the unit', () => {
    const { results } = run(`
local lissom = require "lissom"
local head = lissom.shapes.head{ vertices = 3000 }
local style = lissom.hairstyle(head, { resolution = 8000 })
for _, side in ipairs{ -1, 1 } do
    style:add_stream{ style:at{ azimuth = 10 * side, elevation = 60, lift = 0.01 },
        style:at{ azimuth = 75 * side, elevation = 35, lift = 0.02 },
        style:at{ azimuth = 90 * side, elevation = -20, lift = 0.02 } }
end
local hair = style:grow{ count = 500, length = 0.2 }
return hair, head, style:scalp():unit()`);
    ask('page_read_strands', results[0].object);
    const bytes = number => module._page_list_bytes(number);
    const points = bytes(5) / 12, strands = bytes(6) / 4 - 1;
    assert.ok(strands > 400 && points > 5 * strands, `${strands} strands, ${points} points`);
    assert.equal(bytes(7), 4 * points);
    const unit = module._page_root_unit(results[0].object, results[1].object);
    assert.ok(Math.abs(unit / results[2] - 1) < 0.02, `${unit} in place of ${results[2]}`);
});

test('numbers go into text and come back equal', () => {
    const { results } = run(`
local lissom = require "lissom"
local mesh = lissom.shapes.cactus{ vertices = 2000 }:transform{ rotate = { axis = {1, 2, 3}, angle = 17 }, scale = 1 / 3 }
mesh:save("/tmp/a.obj") mesh:save("/tmp/a.ply") mesh:save("/tmp/a.off")
local text, binary, plain = lissom.load("/tmp/a.obj"), lissom.load("/tmp/a.ply"), lissom.load("/tmp/a.off")
local function far(a, b)
    local most = 0
    for v = 1, a:vertex_count() do
        local x, y, z = a:position(v)
        local i, j, k = b:position(v)
        most = math.max(most, math.abs(x - i), math.abs(y - j), math.abs(z - k))
    end
    return most
end
return far(mesh, text), far(mesh, plain), far(mesh, binary)`);
    assert.deepEqual(results.slice(0, 2), [0, 0]);
    assert.ok(results[2] < 1e-6);
});

test('drawn corners: three a triangle, of unit normals, and edges of faces alone', () => {
    const { results } = run('return require("lissom").shapes.box()');
    ask('page_read_mesh', results[0].object, 50);
    const list = (number, Type) => {
        const at = module._page_list(number), bytes = module._page_list_bytes(number);
        return new Type(module.HEAPU8.slice(at, at + bytes).buffer);
    };
    const normals = list(1, Float32Array), edges = list(3, Uint8Array);
    assert.equal(normals.length, 3 * edges.length);
    for (let c = 0; c < normals.length; c += 3) assert.ok(Math.abs(Math.hypot(...normals.subarray(c, c + 3)) - 1) < 1e-5);
    // The sides are quads: a third of the sides of their triangles is a diagonal.
    assert.equal(edges.filter(edge => edge === 0).length, edges.length / 3);
});

test('parameters are declared, set, and refused', () => {
    const script = 'local p = require("lissom").params{ n = { type = "integer", default = 3, min = 1, max = 9 } }\nreturn p.n * 2';
    assert.equal(run(script).results[0], 6);
    const { results, parameters } = run(script, { n: 4 });
    assert.equal(results[0], 8);
    assert.equal(parameters[0].name, 'n');
    assert.throws(() => run(script, { m: 1 }), /n/);
});

test('errors have the line and the code', () => {
    assert.match(refused('local lissom = require "lissom"\nreturn lissom.shapes.box{ widht = 2 }').message, /script\.lua:2:.*widht/s);
    assert.match(refused('local x = = 2').message, /script\.lua:1:/);
    assert.equal(refused('require("lissom").load("absent.obj")').code, 'script_error');
    assert.match(refused('local function f() return f() + 1 end\nreturn f()').message, /stack overflow/);
    assert.match(refused('error(setmetatable({}, { __tostring = function() return "own" end }))').message, /no text/);
});

test('what is caught stays caught: pcall, coroutines, lissom.try', () => {
    const { results } = run(`
local lissom = require "lissom"
local a, message = pcall(error, "x")
local mesh, problem = lissom.try(lissom.load, "absent.obj")
local c = coroutine.wrap(function() for i = 1, 3 do coroutine.yield(i) end error("end") end)
return a, message, mesh == nil, problem.code, c() + c() + c(), (pcall(c))`);
    assert.deepEqual(results, [false, 'x', true, 'file_not_found', 6, false]);
});

// A script that returns the counts of what another returns - meshes and hair - and the sum of its coordinates, each with a
// weight of its own.
const summed = script => `local function made(...) ${script}
end
local sums = {}
for _, value in ipairs{ made() } do
    local is_mesh, positions = pcall(function() return value:positions() end)
    local is_hair, points = pcall(function() return value:points() end)
    local numbers = is_mesh and positions or points
    if is_mesh or is_hair then
        local sum, place = 0, 0
        for i = 1, numbers:count() do
            for _, x in ipairs{ numbers:get(i) } do
                place = place + 1
                sum = sum + x * math.sin(place)
            end
        end
        sums[#sums + 1] = numbers:count()
        sums[#sums + 1] = sum
    end
end
return table.unpack(sums)`;

// The same from the program.
function sumsOfProgram(name, script) {
    const file = path.join(fs.mkdtempSync(path.join(os.tmpdir(), 'lissom-web-')), `${name}.lua`);
    fs.writeFileSync(file, `${script.replace('return table.unpack(sums)', 'for _, x in ipairs(sums) do print(("%.17g"):format(x)) end')}`);
    return execFileSync(program, ['run', file], { encoding: 'utf8' }).trim().split('\n').map(Number);
}

// Vertices and strands are as many as elsewhere; places agree to what machines differ by that fuse products or do not.
test('the scripts of all hosts return the same as from the program', () => {
    if (!program) return console.log('        skipped: no program to compare with');
    const hosts = path.join(path.dirname(fileURLToPath(import.meta.url)), '../../examples/hosts');
    for (const file of fs.readdirSync(hosts).filter(file => file.endsWith('.lua'))) {
        const script = summed(fs.readFileSync(path.join(hosts, file), 'utf8'));
        const ours = run(script).results, theirs = sumsOfProgram(path.basename(file, '.lua'), script);
        assert.ok(ours.length > 0 && ours.length === theirs.length, `${file}: ${ours} and ${theirs}`);
        ours.forEach((sum, i) => {
            const off = Math.abs(sum - theirs[i]) / Math.max(1, Math.abs(theirs[i]));
            console.log(`        ${file.padEnd(14)} ${sum} ${off === 0 ? 'equal' : off.toExponential(1)}`);
            assert.ok(i % 2 ? off < 1e-6 : off === 0, `${file}: ${sum}, not ${theirs[i]}`);
        });
    }
    return undefined;
});

test('print goes to the log', () => {
    log.length = 0;
    run('print("one", 2)');
    assert.match(log.join(''), /one\s2/);
});

test('memory that is refused leaves the context usable', () => {
    ask('page_open', 64e6);
    assert.equal(refused('return require("lissom").shapes.sphere{ segments = 4000 }').status !== 0, true);
    assert.equal(run('return 1').results[0], 1);
    ask('page_open', 0);
});

test('the time of a sandbox ends a script without an end, and the next one runs', () => {
    ask('page_open', 0);
    ask('page_sandbox', 0.3);
    const start = performance.now();
    const error = refused('while true do end');
    const seconds = (performance.now() - start) / 1000;
    assert.match(error.message, /time of the script is over/);
    assert.ok(seconds > 0.25, `${seconds} s`);
    assert.equal(run('return 2').results[0], 2);
    ask('page_open', 0);
});

let failed = 0;
for (const { name, check } of cases) {
    try {
        check();
        console.log(`ok      ${name}`);
    } catch (error) {
        ++failed;
        console.log(`FAILED  ${name}\n${error.stack}`);
    }
}
console.log(`${cases.length - failed} of ${cases.length} passed`);
process.exit(failed ? 1 : 0);
