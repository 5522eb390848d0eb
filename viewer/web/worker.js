// Runs scripts beside the page: the library with Lua, in a module worker. The page ends a script by ending the worker.
//
//     { kind: 'run', id, script, name, values, files, inputs }  ->  log*, progress*, { kind: 'ran', id, ... }
//     { kind: 'save', id, object, type, extension }  ->  { kind: 'saved', id, bytes | error }
//     { kind: 'hand', id, at, inputs }  ->  log*, progress*, { kind: 'hand', id, picture, marks, tool, ... }: hand.lua
import createLissom from './lissom.mjs';
import { hairLight } from './hair_light.js';
import { rgb, toLinear } from './colors.js';

const lists = ['positions', 'normals', 'vertices', 'edges', 'colors', 'points', 'offsets', 'widths'];
const kFloat = Float32Array, kInt = Uint32Array, kByte = Uint8Array;
const most = { lines: 2000, memory: 3.2e9 };
let lissom, prelude, handScript, shown = null;

// ---- Messages of a script, at once if it is slow and in bunches if they are many

const log = { lines: [], at: 0, count: 0 };
function tell(level, text) {
    if (++log.count > most.lines) {
        if (log.count === most.lines + 1) log.lines.push({ level: 2, text: `more than ${most.lines} lines: the rest is left out` });
    } else {
        log.lines.push({ level, text: text.replace(/\n$/, '').slice(0, 4000) });
    }
    if (performance.now() - log.at > 60) flush();
}
function flush() {
    if (log.lines.length) postMessage({ kind: 'log', lines: log.lines });
    log.lines = [];
    log.at = performance.now();
}

let told = 0;
function progress(label, fraction) {
    const now = performance.now();
    if (now - told < 80) return;
    told = now;
    postMessage({ kind: 'progress', label, fraction });
}

// ---- Calls

const call = (name, types, values) => lissom.ccall(name, 'boolean', types, values);
const answer = () => JSON.parse(lissom.ccall('page_answer', 'string', [], []));
function ask(name, types = [], values = []) {
    if (!call(name, types, values)) throw Object.assign(new Error('refused'), { refusal: answer() });
    return true;
}
function load(text, name) {
    ask('page_load', ['string', 'string'], [text, name]);
    return answer();
}
function runLoaded(args = '') {
    ask('page_run', ['string'], [args]);
    return answer();
}
function list(name, Type) {
    const at = lissom._page_list(lists.indexOf(name)) >>> 0, bytes = lissom._page_list_bytes(lists.indexOf(name)) >>> 0;
    return new Type(lissom.HEAPU8.slice(at, at + bytes).buffer);
}

// ---- Pictures

function boxOf(positions, place) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < positions.length; i += 3) {
        for (let k = 0; k < 3; ++k) {
            const x = place ? place[k] * positions[i] + place[4 + k] * positions[i + 1] + place[8 + k] * positions[i + 2] + place[12 + k]
                : positions[i + k];
            if (x < low[k]) low[k] = x;
            if (x > high[k]) high[k] = x;
        }
    }
    return positions.length ? { low, high } : null;
}

function joined(a, b) {
    if (!a || !b) return a || b;
    return { low: a.low.map((x, k) => Math.min(x, b.low[k])), high: a.high.map((x, k) => Math.max(x, b.high[k])) };
}

// Rows of Lua's 4 x 4 matrix, or an offset, as WebGL's columns.
function placeOf({ transform, offset }) {
    if (transform) return new Float32Array([0, 1, 2, 3].flatMap(c => [0, 1, 2, 3].map(r => transform[r][c])));
    if (offset) return new Float32Array([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, ...offset, 1]);
    return null;
}

function scalarNumbers(drawn, count) {
    const scalars = drawn.scalars;
    if (!scalars) return null;
    if (scalars.numbers) return scalars.numbers;
    const named = scalars.name ? call('page_read_attribute', ['number', 'string'], [drawn.mesh.object, scalars.name])
        : call('page_read_numbers', ['number'], [scalars.buffer.object]);
    const values = named ? list('colors', kFloat) : [];
    return values.length === count ? values : null;
}

// A colour of each vertex: the mesh's own, or the one that it is given.
function vertexColors(drawn, picture, count, own) {
    const colors = new kByte(3 * count), base = rgb(drawn.color);
    const width = own.length / count;
    for (let v = 0; v < count; ++v) {
        const color = own.length && picture.vertex_colors !== false && !(own[width * v] !== own[width * v])
            ? [0, 1, 2].map(k => Math.round(255 * Math.min(Math.max(own[width * v + k], 0), 1))) : base;
        colors.set(color, 3 * v);
    }
    return colors;
}

function rangeOf(numbers, picture) {
    if (picture.range) return picture.range;
    const finite = Array.from(numbers).filter(Number.isFinite);
    return [finite.reduce((a, b) => Math.min(a, b), Infinity), finite.reduce((a, b) => Math.max(a, b), -Infinity)];
}

// The first triangle of each face, and the end: a face of n sides has n - 2 triangles, which have n of its edges.
function facesOf(edges) {
    const starts = [];
    for (let t = 0; 3 * t < edges.length;) {
        starts.push(t);
        for (let count = 1, sides = 0; 3 * t < edges.length; ++count) {
            sides += edges[3 * t] + edges[3 * t + 1] + edges[3 * t + 2];
            ++t;
            if (sides >= count + 2) break;
        }
    }
    return [...starts, edges.length / 3];
}

// Paints faces: `paint(face, its first corner, the end of them)` for those with all vertices in `has`.
function forFaces(starts, vertices, has, paint) {
    for (let f = 0; f + 1 < starts.length; ++f) {
        let all = true;
        for (let c = 3 * starts[f]; all && c < 3 * starts[f + 1]; ++c) all = has(vertices[c]);
        if (all) paint(3 * starts[f], 3 * starts[f + 1]);
    }
}

// The parts of a mesh: their faces, or without `edges` the surface around their vertices.
function paintParts(parts, colors, vertices, edges, flags) {
    const starts = edges && parts.length ? facesOf(edges) : null;
    for (const part of parts) {
        if (!call('page_read_region', ['number'], [part.region.object])) continue;
        const color = rgb(part.color), inside = new Set(list('vertices', kInt)), has = v => inside.has(v);
        const put = c => { colors.set(color, 4 * c); if (flags) flags[c] &= 7; };
        if (starts) forFaces(starts, vertices, has, (c, end) => { for (; c < end; ++c) put(c); });
        else for (let c = 0; c < vertices.length; ++c) if (has(vertices[c])) put(c);
    }
}

// Places of the vertices of handles and parts that no painted face shows, as balls.
function looseVertices(parts, vertices, positions, edges) {
    const starts = parts.length ? facesOf(edges) : [], balls = [];
    for (const part of parts) {
        if (!call('page_read_region', ['number'], [part.region.object])) continue;
        const inside = new Set(list('vertices', kInt)), shown = new Set(), beside = new Set(), places = new Map();
        forFaces(starts, vertices, v => inside.has(v), (c, end) => { for (; c < end; ++c) shown.add(vertices[c]); });
        for (let c = 0; c < vertices.length; ++c) {
            const t = c - c % 3, v = vertices[c];
            if (!inside.has(v)) continue;
            places.set(v, positions.subarray(3 * c, 3 * c + 3));
            if ([0, 1, 2].some(k => shown.has(vertices[t + k]))) beside.add(v);
        }
        for (const [v, place] of places) if (!beside.has(v)) balls.push({ color: part.color, place: Array.from(place) });
    }
    return balls;
}

// Numbers as places on the scale, whose colours the shader has; faces without a number are grey.
function paintNumbers(numbers, range, colors, vertices, edges, flags) {
    const starts = facesOf(edges), gray = rgb('noValue');
    for (let c = 0; c < vertices.length; ++c) colors.set(gray, 4 * c);
    forFaces(starts, vertices, v => Number.isFinite(numbers[v]), (c, end) => {
        for (; c < end; ++c) {
            colors[4 * c + 3] = 255 * Math.min(Math.max((numbers[vertices[c]] - range[0]) / (range[1] - range[0] || 1), 0), 1) + 0.5;
            flags[c] |= 8;
        }
    });
}

// Colours of corners, of the mesh whose lists were read last. `edges` and `flags`: of a mesh that is read as a whole.
function cornerColors(drawn, picture, vertices, edges = null, flags = null) {
    const own = list('colors', kFloat), stored = lissom._page_vertex_count(drawn.mesh.object);
    let count = stored;
    for (const v of vertices) if (v >= count) count = v + 1;
    const perVertex = vertexColors(drawn, picture, count, own), colors = new kByte(4 * vertices.length);
    for (let c = 0; c < vertices.length; ++c) {
        const v = 3 * vertices[c];
        colors[4 * c] = perVertex[v]; colors[4 * c + 1] = perVertex[v + 1]; colors[4 * c + 2] = perVertex[v + 2];
    }
    const parts = drawn.parts || [], isHandle = part => part.color === 'handle';
    paintParts(parts.filter(part => !isHandle(part)), colors, vertices, edges, flags);
    const numbers = edges && scalarNumbers(drawn, count), range = numbers ? rangeOf(numbers, picture) : null;
    if (numbers) paintNumbers(numbers, range, colors, vertices, edges, flags);
    paintParts(parts.filter(isHandle), colors, vertices, edges, flags);
    return { colors, range };
}

// Of each corner the edges of its triangle that are edges of a face, a bit each.
function edgeFlags(edges) {
    const flags = new kByte(edges.length);
    for (let c = 0; c < edges.length; ++c) {
        const t = c - c % 3;
        flags[c] = edges[t] | edges[t + 1] << 1 | edges[t + 2] << 2;
    }
    return flags;
}

const creaseOf = (picture, creaseFree) => picture.crease ?? (creaseFree ? 180 : 50);
const countsOf = id => ({ vertexCount: lissom._page_vertex_count(id), faceCount: lissom._page_face_count(id) });

function meshOf(drawn, picture, creaseFree) {
    const id = drawn.mesh.object;
    ask('page_read_mesh', ['number', 'number'], [id, creaseOf(picture, creaseFree)]);
    const positions = list('positions', kFloat), normals = list('normals', kFloat), place = placeOf(drawn);
    const edges = list('edges', kByte), flags = edgeFlags(edges);
    const vertices = list('vertices', kInt), painted = cornerColors(drawn, picture, vertices, edges, flags);
    const balls = looseVertices((drawn.parts || []).filter(part => part.color !== 'region'), vertices, positions, edges);
    return { object: id, positions, normals, flags, balls, place, caption: drawn.caption, box: boxOf(positions, place),
        legend: (drawn.parts || []).filter(part => part.name).map(part => ({ name: part.name, color: part.color })),
        ...painted, ...countsOf(id) };
}

function boundaryLines(id) {
    const lines = [], positions = new Map();
    const count = lissom._page_boundary_count(id);
    if (count <= 0) return lines;
    ask('page_read_mesh', ['number', 'number'], [id, 50]);
    const places = list('positions', kFloat), vertices = list('vertices', kInt);
    vertices.forEach((v, c) => positions.set(v, places.subarray(3 * c, 3 * c + 3)));
    for (let b = 0; b < count; ++b) {
        ask('page_read_boundary', ['number', 'number'], [id, b]);
        const loop = Array.from(list('vertices', kInt));
        lines.push({ color: b + 1, points: [...loop, loop[0]].flatMap(v => Array.from(positions.get(v) || [0, 0, 0])) });
    }
    return lines;
}

// A number from 0 to 1 of a number.
function chance(n) {
    n = Math.imul(n ^ n >>> 16, 0x45d9f3b);
    n = Math.imul(n ^ n >>> 16, 0x45d9f3b);
    return ((n ^ n >>> 16) >>> 0) / 4294967296;
}

// Points in the mesh's unit, with half a width, and below zero at the last of a strand; one before and after all.
function strandsOf(strands, picture, head, lit = null) {
    const id = strands.object, look = picture.hair || {};
    ask('page_read_strands', ['number'], [id]);
    const places = list('points', kFloat), offsets = list('offsets', kInt), widths = list('widths', kFloat), own = list('colors', kFloat);
    const scale = 1 / (look.unit || (head ? lissom._page_root_unit(id, head.object) : 0) || 1);
    const count = places.length / 3, points = new Float32Array(4 * (count + 3)), colors = new kByte(4 * (count + 3));
    const base = rgb(look.color || '#5a3c25').map(toLinear);
    const [atRoot, atTip] = [look.root_tone ?? 0.72, look.tip_tone ?? 1.18], roots = [0, 0, 0];
    for (let i = 0; i < places.length; ++i) places[i] *= scale;
    for (let p = 0; p < count; ++p) widths[p] *= scale;
    points.fill(-1, 0, 4);
    for (let s = 0; s + 1 < offsets.length; ++s) {
        const tone = 1 + 0.24 * (chance(s + 1) - 0.5), lean = 255 * chance(7 * s + 3);
        for (let p = offsets[s]; p < offsets[s + 1]; ++p) {
            const along = (p - offsets[s]) / Math.max(offsets[s + 1] - offsets[s] - 1, 1), to = 4 * (p + 1);
            points.set(places.subarray(3 * p, 3 * p + 3), to);
            const last = p + 1 === offsets[s + 1];
            points[to + 3] = last ? -Math.max(0.5 * widths[p], 1e-9) : 0.5 * widths[p];
            const shade = tone * (atRoot + (atTip - atRoot) * along);
            for (let k = 0; k < 3; ++k) {
                const linear = own.length && !look.color ? own[3 * p + k] : base[k];
                colors[to + k] = 255 * Math.sqrt(Math.min(linear * shade, 1));
                if (p === offsets[s]) roots[k] += linear * atRoot / (offsets.length - 1);
            }
            colors[to + 3] = lean;
        }
    }
    points.fill(-1, 4 * (count + 1));
    const starts = Array.from({ length: 65 }, (_, i) => offsets[Math.floor((offsets.length - 1) * i / 64)]);
    const light = lit || hairLight(places, offsets, widths, head?.positions, scale);
    if (light) light.color = roots;
    return { object: id, points, colors, starts, light, box: boxOf(places), count: offsets.length - 1,
        look: { shadow: Math.min(look.shadow ?? 1, 1),
            lobes: [look.primary ?? 0.14, look.secondary ?? 0.42, look.primary_exponent ?? 26,
                look.secondary_exponent ?? 10] } };
}

function drawnPicture(picture) {
    const meshes = picture.meshes.map(mesh => meshOf(mesh, picture, picture.strands.length > 0 && picture.crease === undefined));
    const lines = (picture.lines || []).map(points => ({ color: 'orange', points: points.flat() }));
    if (picture.boundaries) for (const mesh of picture.meshes) lines.push(...boundaryLines(mesh.mesh.object));
    const strands = picture.strands.map(one => strandsOf(one, picture, meshes[0]));
    const box = [...meshes, ...strands].map(one => one.box).reduce(joined, null);
    const { name, wire, flat, columns, fit, view, up, camera } = picture;
    const balls = rowOf(picture.points).filter(Array.isArray).map(place => ({ color: 'handle', place }));
    return { name, wire, flat, columns, fit, view, up, camera, meshes, strands, lines, balls, box };
}

function buffersOf(picture) {
    const given = list => list.filter(one => !one.same);
    return [...given(picture.meshes).flatMap(m => [m.positions, m.normals, m.colors, m.flags]),
        ...given(picture.strands).flatMap(s => [s.points, s.colors, ...(s.light ? new Set([s.light.texels, s.light.onHead, s.light.tint]) : [])])].filter(Boolean).map(list => list.buffer);
}

// ---- Tools: the picture after inputs of a hand; the page has its parts of the same key already

// Keys that the page has, numbers of objects, and corners of meshes by their numbers; the head below hair.
const held = {};
function forgetHand() {
    Object.assign(held, { isLoaded: false, keys: new Map(), objects: new Map(), corners: new Map(), head: null, lights: new Map(), isDown: false });
}
forgetHand();

function forgetMesh(id) {
    held.corners.delete(id);
    lissom._page_forget_mesh(id);
}
function forgetPicture() {
    held.keys.clear();
    for (const id of [...held.corners.keys()]) forgetMesh(id);
}

// Of a mesh that the page has already the lists that are others now.
function changedMesh(drawn, picture, creaseFree) {
    const id = drawn.mesh.object;
    ask('page_read_change', ['number', 'number'], [id, creaseOf(picture, creaseFree)]);
    const change = answer(), mesh = { object: id, place: placeOf(drawn), legend: [], ...countsOf(id) };
    if (change === 2) held.corners.set(id, list('vertices', kInt));
    if (change === 2) mesh.flags = edgeFlags(list('edges', kByte));
    if (change > 0) Object.assign(mesh, { positions: list('positions', kFloat), normals: list('normals', kFloat) });
    if (change > 0) mesh.box = boxOf(mesh.positions, mesh.place);
    return { ...mesh, ...cornerColors(drawn, picture, held.corners.get(id)) };
}

// The places of the head, for the light in hair.
function headOf(drawn) {
    if (held.head?.key === drawn.key) return held.head;
    ask('page_read_mesh', ['number', 'number'], [drawn.mesh.object, 180]);
    held.head = { key: drawn.key, object: drawn.mesh.object, positions: list('positions', kFloat) };
    return held.head;
}

// Numbers of objects in a result, and their types.
function objectsIn(value, found = new Map()) {
    if (value === null || typeof value !== 'object') return found;
    if (typeof value.object === 'number' && typeof value.type === 'string') found.set(value.object, value.type);
    else for (const one of Object.values(value)) objectsIn(one, found);
    return found;
}

// Forgets objects that the last answer lacks; those of the script's pictures keep their numbers.
function releaseAllBut(objects) {
    const pictures = objectsIn(shown);
    for (const [id, type] of held.objects) {
        if (objects.has(id)) continue;
        held.keys.delete(id);
        forgetMesh(id);
        if (!pictures.has(id)) ask('page_release', ['number', 'string'], [id, type]);
    }
    held.objects = objects;
}

// Reads an object unless the page has it as it is.
function unlessKnown(object, key, read) {
    if (held.keys.get(object) === key) return { object, same: true };
    held.keys.set(object, key);
    return read();
}

// Lists that Lua leaves empty may come as tables of names.
const rowOf = value => (Array.isArray(value) ? value : []);

// While a button is down the light in hair stays as it was: it takes longer than the hair itself.
function handStrands(strands, picture, head, place) {
    const lit = held.isDown ? held.lights.get(place) : null;
    const copied = light => light && { ...light, texels: light.texels.slice(), onHead: light.onHead.slice(), tint: light.tint.slice() };
    const made = strandsOf(strands, picture, head && headOf(head), copied(lit));
    if (!lit) held.lights.set(place, copied(made.light));
    return made;
}

function handPicture(picture) {
    const all = rowOf(picture.meshes), hair = rowOf(picture.strands);
    const isSmooth = hair.length > 0 && picture.crease === undefined;
    const meshes = all.map(one => ({ ...unlessKnown(one.mesh.object, one.key, () => changedMesh(one, picture, isSmooth)), raised: one.raised }));
    const strands = hair.map((one, i) => unlessKnown(one.strands.object, one.key, () => handStrands(one.strands, picture, all[0], i)));
    const lines = rowOf(picture.lines).map(points => ({ color: 'orange', points: points.flat() }));
    return { meshes, strands, lines, wire: picture.wire, flat: picture.flat };
}

function hand(message) {
    const start = performance.now(), reply = { kind: 'hand', id: message.id };
    let buffers = [];
    log.count = 0;
    try {
        if (!held.isLoaded) {
            load(handScript, 'hand.lua');
            runLoaded();
            load('return playground.hand(...)', 'hand');
            held.isLoaded = true;
        }
        if (message.fresh) forgetPicture();
        const [{ picture, ...seen }] = runLoaded(JSON.stringify([message.at + 1, message.inputs]));
        held.isDown = seen.held;
        Object.assign(reply, seen, { picture: handPicture(picture), keys: [...rowOf(picture.meshes), ...rowOf(picture.strands)].map(one => one.key.split('|')[0]) });
        releaseAllBut(objectsIn(picture));
        buffers = [...buffersOf(reply.picture)];
    } catch (error) {
        forgetPicture();
        reply.failures = [error.refusal || { code: 'internal', message: String(error.message || error) }];
        if (!error.refusal) reply.broken = true;
    }
    reply.ms = performance.now() - start;
    reply.memory = lissom.HEAPU8.length;
    flush();
    postMessage(reply, buffers);
}

// ---- Files

const folder = '/work';
function emptied(path) {
    for (const name of lissom.FS.readdir(path)) {
        if (name === '.' || name === '..') continue;
        const one = `${path}/${name}`;
        if (lissom.FS.isDir(lissom.FS.stat(one).mode)) { emptied(one); lissom.FS.rmdir(one); } else lissom.FS.unlink(one);
    }
}
function written(path = folder, known = new Set(), found = []) {
    for (const name of lissom.FS.readdir(path)) {
        if (name === '.' || name === '..') continue;
        const one = `${path}/${name}`;
        if (lissom.FS.isDir(lissom.FS.stat(one).mode)) written(one, known, found);
        else if (!known.has(one)) found.push({ name: one.slice(folder.length + 1), size: lissom.FS.stat(one).size });
    }
    return found;
}
function putFile(path, content) {
    const parts = path.split('/');
    for (let i = 2; i < parts.length; ++i) {
        const above = parts.slice(0, i).join('/');
        if (!lissom.FS.analyzePath(above).exists) lissom.FS.mkdir(above);
    }
    lissom.FS.writeFile(path, content);
}

// ---- A run

function begin(message) {
    ask('page_open', ['number'], [most.memory]);
    forgetHand();
    emptied(folder);
    for (const { name, bytes } of message.inputs || []) putFile(`${folder}/${name}`, bytes);
    putFile(`${folder}/${message.name}`, message.script);
    lissom.FS.chdir(folder);
    load(prelude, 'prelude.lua');
    runLoaded();
}

// The library runs a script for its parameters only if its text speaks of them; those of modules count here.
function mayDeclare(script) {
    return /params/.test(script) || /require\s*\(?\s*["'](?!lissom["'])/.test(script) ? '-- params\n' : '';
}

function run(message) {
    const start = performance.now();
    log.count = 0;
    const reply = { kind: 'ran', id: message.id, ok: false, parameters: [] };
    const known = new Set([message.name, ...(message.inputs || []).map(file => file.name)].map(name => `${folder}/${name}`));
    let buffers = [];
    try {
        begin(message);
        reply.parameters = load(`${mayDeclare(message.script)}return playground.run(${JSON.stringify(message.name)})`, 'page');
        for (const one of reply.parameters) {
            const value = message.values?.[one.name];
            if (value === undefined) continue;
            ask('page_set', ['string', 'string'], [one.name, String(value)]);
        }
        let [pictures] = runLoaded();
        const saved = !pictures?.length && written(folder, known).map(file => file.name).filter(name => /\.(obj|glb|ply|off|stl)$/.test(name)).pop();
        if (saved) {
            // A script that only saves shows its files.
            load(`return playground.shown(require("lissom").load(${JSON.stringify(saved)}))`, 'page');
            [pictures] = runLoaded();
        }
        reply.ms = performance.now() - start;
        shown = pictures || [];
        reply.pictures = shown.length ? shown.map(picture => ({ name: picture.name })) : [];
        const own = message.name.replace(/\.lua$/, ''), place = name => reply.pictures.findIndex(one => one.name === name);
        const at = Math.max(place(message.picture) >= 0 ? place(message.picture) : place(own), 0);
        if (shown.length) {
            reply.at = at;
            reply.picture = drawnPicture(shown[at]);
            buffers = buffersOf(reply.picture);
        }
        reply.ok = true;
    } catch (error) {
        reply.error = error.refusal || { code: 'internal', message: String(error.message || error) };
        if (!error.refusal) reply.broken = true;
    }
    try {
        reply.files = written(folder, known);
        reply.memory = lissom.HEAPU8.length;
    } catch { reply.files = []; }
    flush();
    postMessage(reply, buffers);
}

function select(message) {
    const picture = drawnPicture(shown[message.at]);
    postMessage({ kind: 'picture', id: message.id, at: message.at, picture }, buffersOf(picture));
}

// An object of the picture as the bytes of a file.
function save(message) {
    try {
        const path = `/tmp/saved.${message.extension}`;
        ask('page_call', ['string', 'string'], [`${message.type}.save`, JSON.stringify([{ object: message.object }, path])]);
        const bytes = lissom.FS.readFile(path);
        lissom.FS.unlink(path);
        postMessage({ kind: 'saved', id: message.id, bytes }, [bytes.buffer]);
    } catch (error) {
        postMessage({ kind: 'saved', id: message.id, error: error.refusal?.message || String(error) });
    }
}

function read(message) {
    const bytes = lissom.FS.readFile(`${folder}/${message.name}`);
    postMessage({ kind: 'saved', id: message.id, bytes }, [bytes.buffer]);
}

const ready = (async () => {
    const start = performance.now();
    const [module, text, tools, scripts] = await Promise.all([
        createLissom({ lissomLog: tell, lissomProgress: progress, print: text => tell(1, text), printErr: text => tell(2, text) }),
        fetch('prelude.lua').then(response => response.text()),
        fetch('hand.lua').then(response => response.text()),
        fetch('scripts.json').then(response => response.json()),
    ]);
    lissom = module;
    prelude = text;
    handScript = tools;
    lissom.FS.mkdir(folder);
    for (const [name, content] of Object.entries(scripts)) putFile(`/lissom/${name}`, content);
    postMessage({ kind: 'ready', version: lissom.ccall('page_version', 'string', [], []), ms: performance.now() - start });
})();
ready.catch(error => postMessage({ kind: 'failed', message: String(error.message || error) }));

onmessage = async ({ data }) => {
    await ready;
    ({ run, save, select, read, hand })[data.kind](data);
};
